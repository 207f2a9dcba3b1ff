// A path of light: where it is, what it is in, what has become of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/crystal.glsl"
#include "lib/ray.glsl"
#include "transport/object_set.glsl"
#include "transport/status.glsl"

struct Path {
    Ray ray;
    Ray lost;         // what rounding has kept back of it
    vec3 throughput;  // what is left of its light, or the share of what it meets that the eye sees
    ObjectSet objects; // those it is in, a bit each
    int depth;        // interfaces met
    int mode;          // lib/crystal.glsl: the wave that it is in a crystal; kUnsplit elsewhere,
    vec3 polarisation; // where E is along this vector, as long as the root of the degree. Of both waves together
                       // Stokes' (s1, s2, s3) over s0, by the o-wave's E and the e-wave's
    float departs;    // how steeply it leaves the interface it starts on; 0: on none
    int status;
    int steps;        // so far: of the index field, pieces of straight way, looks for boundaries
    int mostSteps;    // it may make
    float error;      // adaptive: the steps' own estimates of how far off its end is [voxel]
    dvec2 lengths;    // optical path length, path length [voxel]
};

Path pathFrom(vec3 x, vec3 w, int mostSteps) {
    return Path(Ray(x, w), Ray(vec3(0.0), vec3(0.0)), vec3(1.0), ObjectSet(0u), 0, kUnsplit, vec3(0.0), 0.0,
                kAlive, 0, mostSteps, 0.0, dvec2(0.0));
}

// A piece of a path, short enough for one look at the medium.
struct Piece {
    vec3 start;
    vec3 along;     // from there to its end
    vec3 middle;
    vec3 direction; // of length 1, or nearly
    float extent;   // its length [voxel]
    float n;        // the index
    int region;
};

Piece pieceFrom(vec3 start, vec3 direction, float extent, float n, int region) {
    vec3 along = extent * direction;
    return Piece(start, along, start + 0.5 * along, direction, extent, n, region);
}
