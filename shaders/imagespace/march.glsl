// Which surface a ray meets next, among layers of depths and normals: a march in texture space.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where `params`, the layers and imagespace/view.glsl are. Each sample of the march is compared with what
// its texel tells of inside and outside. Where that is not the ray's own state any more, the ray has met a surface
// since the sample before: the one nearest by that looks the right way, so that no ray meets the surface that it
// starts on, however coarse the texels.

const int kLeaves = 0; // the picture, or all surfaces
const int kBody = 1;
const int kPlate = 2;

struct Hit {
    int kind;
    vec3 x;
    vec3 normal; // outward of bodies
    vec3 albedo; // of plates
    int probes;
};

vec4 layerAt(ivec2 texel, int layer) {
    return texelFetch(fronts, ivec3(texel, layer), 0);
}

// A piece of a ray as its projection runs: s from 0 to 1 is even in texture space.
struct Track {
    vec3 start;
    vec3 direction;
    float extent; // [unit]
    float from;   // depths of its ends
    float to;
    vec2 first;   // texels of its ends
    vec2 last;
    float least; // where it comes into the picture
    float most;  // where it leaves it
};

// 1 / depth is even there, as in eq. 7 of Oliveira and Brauwers 2007.
float distanceAt(Track track, float s) {
    if (params.window.z == 0.0) return s * track.extent;
    return track.extent * (s * track.from) / max((1.0 - s) * track.to + s * track.from, 1.0e-30);
}

Track trackOf(vec3 start, vec3 direction) {
    Track track;
    track.start = start;
    track.direction = direction;
    float far = params.depths.y;
    float near = params.depths.x;
    float extent = params.depths.z;
    if (direction.z > 1.0e-6) extent = min(extent, max(far - start.z, 0.0) / direction.z);
    if (direction.z < -1.0e-6) extent = min(extent, max(start.z - near, 0.0) / -direction.z);
    vec3 end = start + extent * direction;
    track.extent = extent;
    track.from = start.z;
    track.to = max(end.z, 0.5 * near);
    track.first = texelOf(start);
    track.last = texelOf(vec3(end.xy, track.to));
    track.least = 0.0;
    track.most = 1.0;
    vec2 along = track.last - track.first;
    vec2 size = vec2(params.picture.xy);
    for (int i = 0; i < 2; ++i) {
        if (abs(along[i]) < 1.0e-6) continue;
        float a = -track.first[i] / along[i];
        float b = (size[i] - track.first[i]) / along[i];
        track.least = max(track.least, min(a, b));
        track.most = min(track.most, max(a, b));
    }
    return track;
}

// Whether a point is within the body, as its texel tells.
bool isOccupied(ivec2 texel, float z) {
    int count = 0;
    for (int k = 0; k < params.limits.y; ++k) {
        float w = layerAt(texel, k).w;
        if (w == 0.0 || abs(w) >= z) break;
        count += w > 0.0 ? 1 : -1;
    }
    return count > 0;
}

// Of a texel the surface nearest to a depth that a ray may have met: seen from behind by one that leaves the
// body, from before by one that enters it.
vec4 surfaceMet(ivec2 texel, float z, vec3 direction, bool inside) {
    vec4 best = vec4(0.0);
    float least = 3.0e38;
    for (int k = 0; k < params.limits.y; ++k) {
        vec4 one = layerAt(texel, k);
        if (one.w == 0.0) break;
        bool looks = (dot(one.xyz, direction) > 0.0) == inside;
        float off = abs(abs(one.w) - z);
        if (looks && off < least) {
            least = off;
            best = one;
        }
    }
    return best;
}

// The surface round a point, smoothly: the mean of its four texels' planes and normals, as far as they are of one
// surface. xyz: normal, w: how far the point is before the surface.
vec4 smoothSurface(vec3 x, float facing, float reach) {
    vec2 at = texelOf(x) - 0.5;
    ivec2 low = ivec2(floor(at));
    vec2 share = at - vec2(low);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 texel = low + ivec2(i & 1, i >> 1);
        if (!isInPicture(vec2(texel) + 0.5)) continue;
        float weight = ((i & 1) == 1 ? share.x : 1.0 - share.x) * ((i >> 1) == 1 ? share.y : 1.0 - share.y) + 1.0e-4;
        vec4 best = vec4(0.0);
        float least = reach;
        for (int k = 0; k < params.limits.y; ++k) {
            vec4 one = layerAt(texel, k);
            if (one.w == 0.0) break;
            float off = dot(x - pointAt(vec2(texel), abs(one.w)), one.xyz);
            if (one.w * facing > 0.0 && abs(off) < least) {
                least = abs(off);
                best = vec4(one.xyz, off);
            }
        }
        if (least < reach) sum += weight * vec4(best.xyz, best.w);
        if (least < reach) sum.w += 0.0;
    }
    return sum;
}
