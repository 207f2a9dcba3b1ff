// The books of a batch: weights by what became of them, counts. Summed in a fixed order.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/lightsim_params.h"
#include "lightsim/fates.glsl"

layout(local_size_x = 64) in;
layout(std140, binding = 0) uniform Params { PhotonParams params; };
layout(std430, binding = 1) readonly buffer Photons { Photon photons[]; };

struct Account {
    vec4 remaining; // weight in the photons, whatever their fate; w: the largest error [voxel]
    vec4 absorbed;
    vec4 scattered;
    vec4 escaped;  // w: photons that met too many boundaries
    uvec4 count;   // photons, steps, deposits, trapped
};
layout(std430, binding = 2) writeonly buffer Accounts { Account accounts[]; };

void main() {
    uint item = gl_GlobalInvocationID.x;
    uint items = params.list.y;
    if (item >= items) return;
    Account sum = Account(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), uvec4(0u));
    for (uint id = item; id < params.list.w; id += items) {
        Photon photon = photons[id];
        uint fate = photon.count.x;
        if (fate == kNone) continue;
        vec4 weight = vec4(photon.place.w, photon.wave.w, photon.absorbed.w, 0.0);
        float error = uintBitsToFloat(photon.count.w) +
                      6.0e-8 * params.tracing.z * sqrt(float(photon.count.y)); // roundings, at random
        sum.remaining = vec4(sum.remaining.xyz + weight.xyz, max(sum.remaining.w, error));
        sum.absorbed += vec4(photon.absorbed.xyz, 0.0);
        sum.scattered += vec4(photon.scattered.xyz, 0.0);
        if (fate == kEscaped) sum.escaped += weight;
        if (fate == kDeep) sum.escaped.w += 1.0;
        sum.count += uvec4(1u, photon.count.y, photon.count.z, fate == kTrapped ? 1u : 0u);
    }
    accounts[item] = sum;
}
