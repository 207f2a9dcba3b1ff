// Which surface a ray meets next, among layers of depths and normals: a march in texture space.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where `params`, the layers and imagespace/view.glsl are. Each sample of the march is compared with what
// its texel tells of inside and outside. Where that is not the ray's own state any more, the ray has met a surface
// since the sample before: the one nearest by that looks the right way, so that no ray meets the surface that it
// starts on, however coarse the texels. (Depths in several layers: Policarpo and Oliveira 2006, as §5 of Oliveira and
// Brauwers 2007 wishes for.)

const int kLeaves = 0; // the picture, or all surfaces
const int kBody = 1;
const int kPlate = 2;

struct Hit {
    int kind;
    float t; // along the ray [unit]
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
    float most;   // s where it leaves the picture
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
    track.most = 1.0;
    vec2 along = track.last - track.first;
    vec2 size = vec2(params.picture.xy);
    for (int i = 0; i < 2; ++i) {
        if (abs(along[i]) < 1.0e-6) continue;
        float a = -track.first[i] / along[i];
        float b = (size[i] - track.first[i]) / along[i];
        track.most = min(track.most, max(a, b));
    }
    return track;
}

// What a texel's layers tell of a piece of a ray between two depths.
struct Look {
    bool occupied; // its end is within the body
    vec4 met;      // the surface that it has met, if any: the first between its depths
    vec4 nearest;  // else the nearest to its end
};

// Of surfaces that look the right way alone: seen from behind by a ray that leaves the body, from before by one
// that enters it.
Look lookAt(ivec2 texel, float z0, float z1, vec3 direction, bool inside) {
    Look look = Look(false, vec4(0.0), vec4(0.0));
    int count = 0;
    float first = 3.0e38;
    float least = 3.0e38;
    for (int k = 0; k < params.limits.y; ++k) {
        vec4 one = layerAt(texel, k);
        if (one.w == 0.0) break;
        float depth = abs(one.w);
        if (depth < z1) count += one.w > 0.0 ? 1 : -1;
        bool looks = (dot(one.xyz, direction) > 0.0) == inside;
        bool between = (depth - z0) * (depth - z1) <= 0.0;
        if (looks && between && abs(depth - z0) < first) {
            first = abs(depth - z0);
            look.met = one;
        }
        if (looks && abs(depth - z1) < least) {
            least = abs(depth - z1);
            look.nearest = one;
        }
    }
    look.occupied = count > 0;
    return look;
}

// The surface round a point, smoothly: of its four texels those planes and normals that are of one surface, by
// their shares. xyz: the sum of normals, 0 where there is none; w: how far the point is before it.
vec4 smoothSurface(vec3 x, vec4 met, float reach) {
    vec2 at = texelOf(x) - 0.5;
    ivec2 low = ivec2(floor(at));
    vec2 share = at - vec2(low);
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 texel = low + ivec2(i & 1, i >> 1);
        if (!isInPicture(vec2(texel) + 0.5)) continue;
        float weight = ((i & 1) == 1 ? share.x : 1.0 - share.x) * ((i >> 1) == 1 ? share.y : 1.0 - share.y) + 1.0e-4;
        float least = reach;
        vec4 best = vec4(0.0);
        for (int k = 0; k < params.limits.y; ++k) {
            vec4 one = layerAt(texel, k);
            if (one.w == 0.0) break;
            float off = dot(x - pointAt(vec2(texel), abs(one.w)), one.xyz);
            // An edge is no place to smooth: 0.8 is 37 degrees.
            if (one.w * met.w > 0.0 && abs(off) < least && dot(one.xyz, met.xyz) > 0.8) {
                least = abs(off);
                best = vec4(one.xyz, off);
            }
        }
        if (least < reach) {
            sum += weight * best;
            weights += weight;
        }
    }
    return weights > 0.0 ? vec4(sum.xyz, sum.w / weights) : vec4(0.0);
}

// How far along the ray a plane is, and no further than that from a distance known well enough.
float toPlane(Track track, float t, float slack, vec3 point, vec3 normal) {
    float across = dot(track.direction, normal);
    float off = dot(point - (track.start + t * track.direction), normal);
    return abs(across) > 0.05 ? t + clamp(off / across, -slack, slack) : t;
}

Hit bodyHit(Track track, ivec2 texel, vec4 met, float t, bool inside, int probes) {
    float texelWidth = 2.0 * params.window.x * (params.window.z == 1.0 ? abs(met.w) : 1.0) / float(params.picture.x);
    float slack = 3.0 * texelWidth;
    vec3 point = pointAt(vec2(texel), abs(met.w));
    t = max(toPlane(track, t, slack, point, met.xyz), 0.0);
    vec3 x = track.start + t * track.direction;
    vec4 smoothed = smoothSurface(x, met, 2.0 * texelWidth);
    vec3 normal = met.xyz;
    if (smoothed.xyz != vec3(0.0) && (dot(smoothed.xyz, track.direction) > 0.0) == inside) {
        normal = normalize(smoothed.xyz);
        t = max(toPlane(track, t, slack, x - smoothed.w * normal, normal), 0.0);
        x = track.start + t * track.direction;
    }
    return Hit(kBody, t, x, normal, vec3(0.0), probes);
}

#if PLATES == 1
// The first plate between two points of the ray; t is unchanged where there is none.
void meetPlates(Track track, ivec2 texel, float t0, float t1, inout float t, inout Hit hit) {
    vec3 x0 = track.start + t0 * track.direction;
    vec3 x1 = track.start + t1 * track.direction;
    for (int k = 0; k < params.limits.w; ++k) {
        vec4 one = texelFetch(plates, ivec3(texel, k), 0);
        if (one.w == 0.0) break;
        vec3 point = pointAt(vec2(texel), abs(one.w));
        float h0 = dot(x0 - point, one.xyz);
        float h1 = dot(x1 - point, one.xyz);
        if (h0 * h1 > 0.0 || h0 == h1) continue;
        float at = t0 + (t1 - t0) * h0 / (h0 - h1);
        if (at < t) {
            t = at;
            vec3 facing = dot(one.xyz, track.direction) < 0.0 ? one.xyz : -one.xyz;
            hit = Hit(kPlate, at, track.start + at * track.direction, facing, texelFetch(albedos, ivec3(texel, k), 0).xyz,
                      hit.probes);
        }
    }
}
#endif

Hit march(vec3 start, vec3 direction, bool inside) {
    Track track = trackOf(start, direction);
    vec2 along = track.last - track.first;
    // A sample a texel.
    float pieces = clamp(ceil(max(abs(along.x), abs(along.y)) * track.most), 4.0, 8192.0);
    Hit hit = Hit(kLeaves, track.extent, start + track.extent * direction, vec3(0.0), vec3(0.0), 0);
    float t0 = 0.0;
    ivec2 before = ivec2(floor(track.first));
    for (float i = 0.0; i < pieces; i += 1.0) {
        float t1 = distanceAt(track, track.most * (i + 1.0) / pieces);
        ivec2 texel = ivec2(floor(track.first + (track.most * (i + 0.5) / pieces) * along));
        float z0 = start.z + t0 * direction.z;
        float z1 = start.z + t1 * direction.z;
        ++hit.probes;
        if (isInPicture(vec2(texel) + 0.5)) {
            float nearest = t1;
#if PLATES == 1
            meetPlates(track, texel, t0, t1, nearest, hit);
#endif
            Look look = lookAt(texel, z0, z1, direction, inside);
            vec4 met = look.met;
            ivec2 where = texel;
            if (met.w == 0.0 && look.occupied != inside) {
                met = look.nearest;
                // The ray has left the outline: by the surface next to it.
                if (met.w == 0.0) {
                    where = before;
                    met = lookAt(before, z0, z0, direction, inside).nearest;
                }
            }
            if (met.w != 0.0) {
                float t = look.met.w != 0.0 && abs(z1 - z0) > 1.0e-9 ? mix(t0, t1, (abs(met.w) - z0) / (z1 - z0)) : t0;
                Hit body = bodyHit(track, where, met, t, inside, hit.probes);
                if (hit.kind == kLeaves || body.t < hit.t) hit = body;
            }
            if (hit.kind != kLeaves) break;
        }
        before = clamp(texel, ivec2(0), params.picture.xy - 1);
        t0 = t1;
    }
    return hit;
}
