// The energy of a batch of photons: weights by what became of them, counts. Summed in a fixed order.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/bindings.h"
#include "shared/lightsim_params.h"
#include "shared/limits.h"
#include "transport/params.glsl"
#include "transport/status.glsl"

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { PhotonParams params; };
layout(std430, binding = kPhotonsBuffer) readonly buffer Photons { Photon photons[]; };
layout(std430, binding = kEnergyBuffer) writeonly buffer Energy { EnergySum energy[]; };

void main() {
    uint item = gl_GlobalInvocationID.x;
    uint items = params.list.y;
    if (item >= items) return;
    EnergySum sum = EnergySum(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), uvec4(0u));
    for (uint id = item; id < params.list.w; id += items) {
        Photon photon = photons[id];
        int status = int(photon.count.x);
        if (status == kNone) continue;
        // What opaque material has taken: the weight is that of what one more bounce would send on.
        bool stopped = status == kStopped;
        vec4 weight = stopped ? vec4(0.0) : vec4(photon.weight.xyz, 0.0);
        uint steps = photon.count.y & kStepBits;
        sum.remaining = vec4(sum.remaining.xyz + weight.xyz,
                             max(sum.remaining.w, errorOf(photon.wave.w, int(steps))));
        sum.absorbed += vec4(photon.absorbed.xyz, stopped ? dot(photon.weight.xyz, vec3(1.0 / 3.0)) : 0.0);
        sum.scattered += vec4(photon.scattered.xyz, 0.0);
        if (status == kLeft) sum.escaped += weight;
        float mean = dot(weight.xyz, vec3(1.0 / 3.0));
        sum.dropped += mean * vec4(equal(ivec4(status), ivec4(kDeep, kTrapped, kAlive, kFaded)));
        bool traced = status != kLeft || steps > 0u;
        sum.count += uvec4(traced ? 1u : 0u, steps, photon.count.z, status == kTrapped ? 1u : 0u);
    }
    energy[item] = sum;
}
