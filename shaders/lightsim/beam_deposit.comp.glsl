// Lays beams down on surfaces: by triangles, of which every surface voxel gets its share of the area.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle that light has turned over, or folded into a line, carries its power all the same.
#include "lib/cut.glsl"
#include "lib/octahedral.glsl"
#include "lib/random.glsl"
#include "lightsim/beam_node.glsl"
#include "lightsim/surface_deposit.glsl"
#include "shared/beam_params.h"
#include "shared/bindings.h"
#include "transport/status.glsl"

#if !defined(CHANNELS) || !defined(SURFACE_FLOW) || !defined(DISPERSION)
#error CHANNELS must be 1 or 3, SURFACE_FLOW and DISPERSION 0 or 1
#endif

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { BeamParams params; };
layout(std430, binding = kPointsBuffer) readonly buffer Points { BeamPoint points[]; };
#if DISPERSION == 1
layout(std430, binding = kShiftedBuffer) readonly buffer Shifted { BeamPoint shifted[]; };
#endif
layout(std430, binding = kNodesBuffer) readonly buffer Nodes { BeamNode nodes[]; };
layout(std430, binding = kCellsBuffer) readonly buffer Cells { uvec2 cells[]; };
layout(std430, binding = kBeamCountsBuffer) buffer Counts { uint counts[]; };

// A triangle in a box of more fine voxels is so thin a light that points will do, as they will where they are fewer
// than the voxels. Software devices end all loops of a vector after 65,535 rounds, and say nothing of it.
const int kMostRounds = 1024;
const ivec2 kRows = ivec2(2, 60); // of those points: least and most
const float kGrain = 2.0e-4;      // a point's part of what a fine voxel gets by the plain light, if rows allow
const float kThin = 1.0e-3; // a triangle no wider is a line [fine voxel]

// Coordinates with the surface's steepest axis last, and back.
vec3 turnedTo(int axis, vec3 p) {
    return axis == 0 ? p.yzx : axis == 1 ? p.zxy : p;
}

ivec3 turnedBack(int axis, ivec3 p) {
    return axis == 0 ? p.zxy : axis == 1 ? p.yzx : p;
}

// Adds power in fixed point to the surface voxel there, or the next along the axis.
void put(ivec3 fine, int axis, Light light, inout float phase) {
    uint fullest = putOnSurface(fine, axisVector(axis), light, phase);
    if (fullest == kMissedSurface) atomicAdd(counts[kMissedCount], 1u);
    else if (fullest >= kNearFull) atomicOr(counts[kNearFullCount], 1u);
}

// A triangle without area: its power lies along its longest side.
void putLine(vec3 a, vec3 b, vec3 c, int axis, Light light, inout float phase) {
    vec3 ab = b - a;
    vec3 bc = c - b;
    vec3 ca = a - c;
    vec3 from = a;
    vec3 side = ab;
    if (dot(bc, bc) > dot(side, side)) { from = b; side = bc; }
    if (dot(ca, ca) > dot(side, side)) { from = c; side = ca; }
    int parts = clamp(int(2.0 * length(side)) + 1, 1, 64);
    for (int i = 0; i < parts; ++i) {
        vec3 at = from + ((float(i) + 0.5) / float(parts)) * side;
        put(turnedBack(axis, ivec3(floor(at))), axis, scaled(light, 1.0 / float(parts)), phase);
    }
}

// Rows of points, each of which is one grain of a triangle's light.
int rowsOf(Light light) {
    float fine = float(params.size.w);
    float plain = params.limits.z / (params.map.x * fine * fine);
    float power = CHANNELS == 3 ? max(light.power.x, max(light.power.y, light.power.z)) : light.power.x;
    return clamp(int(sqrt(2.0 * power / (kGrain * plain))), kRows.x, kRows.y);
}

// Equal parts at points that are spread evenly over a triangle: the middles of its rows' small triangles that
// stand upright.
uint putSpread(vec3 a, vec3 b, vec3 c, int axis, Light light, int rows, inout float phase) {
    int points = rows * (rows + 1) / 2;
    ivec2 at = ivec2(0);
    for (int k = 0; k < points; ++k) {
        vec2 share = (vec2(at) + 1.0 / 3.0) / float(rows);
        vec3 x = a + share.x * (b - a) + share.y * (c - a);
        put(turnedBack(axis, ivec3(floor(x))), axis, scaled(light, 1.0 / float(points)), phase);
        ++at.x;
        if (at.x + at.y == rows) at = ivec2(0, at.y + 1);
    }
    return uint(points);
}

uint putTriangle(vec3 a, vec3 b, vec3 c, int axis, Light light, inout float phase) {
    vec2 ab = b.xy - a.xy;
    vec2 ac = c.xy - a.xy;
    float area = 0.5 * (ab.x * ac.y - ab.y * ac.x);
    vec2 bc = c.xy - b.xy;
    float longest = sqrt(max(dot(ab, ab), max(dot(ac, ac), dot(bc, bc))));
    if (2.0 * abs(area) <= kThin * max(longest, kThin)) {
        putLine(a, b, c, axis, light, phase);
        return 1u;
    }
    ivec3 low = ivec3(floor(min(a, min(b, c))));
    ivec3 count = ivec3(floor(max(a, max(b, c)))) - low + 1;
    int rounds = count.x * count.y * count.z;
    int rows = rowsOf(light);
    if (rounds > min(rows * (rows + 1) / 2, kMostRounds))
        return putSpread(a, b, c, axis, light, rows, phase);
    vec3 origin = vec3(low);
    a -= origin;
    b -= origin;
    c -= origin;
    sortCorners(a, b, c);
    ab = b.xy - a.xy;
    ac = c.xy - a.xy;
    area = 0.5 * (ab.x * ac.y - ab.y * ac.x);
    uint deposits = 0u;
    ivec3 at = ivec3(0);
    while (at.z < count.z) { // one loop for all three axes: lanes of a vector need not wait for each other
        float part = areaBelow(a, b, c, vec2(at.xy), float(at.z + 1));
        if (at.z > 0) part -= areaBelow(a, b, c, vec2(at.xy), float(at.z));
        float share = clamp(part / area, 0.0, 1.0);
        if (share > 1.0e-6) {
            put(turnedBack(axis, low + at), axis, scaled(light, share), phase);
            ++deposits;
        }
        ++at.x;
        bool rowEnds = at.x == count.x;
        at.x = rowEnds ? 0 : at.x;
        at.y += rowEnds ? 1 : 0;
        bool slabEnds = at.y == count.y;
        at.y = slabEnds ? 0 : at.y;
        at.z += slabEnds ? 1 : 0;
    }
    return deposits;
}

// The polynomials of second degree that are 1 at one of 0, ½, 1 and 0 at the others.
vec3 weightsAt(float t) {
    return vec3((1.0 - t) * (1.0 - 2.0 * t), 4.0 * t * (1.0 - t), t * (2.0 * t - 1.0));
}

// Between nine values, three by three.
vec3 valueIn(vec3 values[9], vec2 at) {
    vec3 u = weightsAt(at.x);
    vec3 v = weightsAt(at.y);
    vec3 sum = vec3(0.0);
    for (int j = 0; j < 3; ++j)
        sum += v[j] * (u.x * values[3 * j] + u.y * values[3 * j + 1] + u.z * values[3 * j + 2]);
    return sum;
}

vec3 directionOf(BeamPoint point) {
    return fromOctahedral(unpackSnorm2x16(uint(point.map.z)));
}

// Where light is laid down, from where the band's middle lands to where that of the other wavelength does.
float shift = 0.0;

// The middle of one of 2^shifts parts of the band that have the same light.
float shiftOf(int part, int shifts) {
    int all = 2 * kMostShifts;
    int i = (2 * part + 1) * (all / 2 >> shifts);
    return 0.5 * (params.shifts[i - 1 >> 2][i - 1 & 3] + params.shifts[i >> 2][i & 3]);
}

// From the one to the other [voxel], if both are on the same surface.
vec3 driftOf(uint id, inout int known) {
#if DISPERSION == 1
    BeamPoint point = points[id];
    BeamPoint there = shifted[id];
    if (landTogether(point, there)) {
        ++known;
        return there.place.xyz - point.place.xyz;
    }
#endif
    return vec3(0.0);
}

// What a point that landed has of a share of the light.
Light lightAt(BeamPoint point, float share) {
    return lightOf(share * point.weight.xyz, kFlow ? directionOf(point) : vec3(0.0), params.map.yzw);
}

// What a cell is laid down as: points that stand for themselves, or a triangle or two of one light.
// Gathered first: whatever lays one down is compiled once for each place that it is called from.
struct Pieces {
    int points;
    uvec4 point;
    float share;   // of each point
    int triangles; // abc, and acd
    vec3 a, b, c, d;
    int axis;
    Light light;   // of each triangle
};

Pieces noPieces() {
    return Pieces(0, uvec4(0u), 0.0, 0, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), 0, Light(vec3(0.0), vec3(0.0)));
}

Pieces onePoint(uint point, float share) {
    Pieces pieces = noPieces();
    pieces.points = 1;
    pieces.point.x = point;
    pieces.share = share;
    return pieces;
}

// A quarter of a cell that is no beam: those of its four points that landed on the same surface span a
// triangle or two, others stand for themselves.
Pieces quarterOf(BeamNode node, ivec2 quarter, float unit) {
    int first = 3 * quarter.y + quarter.x;
    uvec4 ids = uvec4(pointOf(node, first), pointOf(node, first + 1), pointOf(node, first + 4), pointOf(node, first + 3));
    BeamPoint corner[4] = BeamPoint[4](points[ids.x], points[ids.y], points[ids.z], points[ids.w]);
    Pieces pieces = noPieces();
    pieces.points = 4;
    pieces.point = ids;
    pieces.share = 0.0625 * unit;
    uint met = 0u;
    int landed = 0;
    bool same = true;
    int missing = 0;
    for (int i = 0; i < 4; ++i) {
        bool lands = corner[i].event.x == uint(kStopped);
        if (!lands) missing = i;
        else if (landed++ == 0) met = corner[i].event.y;
        else same = same && corner[i].event.y == met;
    }
    if (landed < 3 || !same) return pieces;
    int known = 0;
    vec3 drift = vec3(0.0); // the mean of those known: parts of a triangle go together
    for (int i = 0; i < 4; ++i) drift += driftOf(ids[i], known);
    drift *= shift / float(max(known, 1));
    int a = landed == 4 ? 0 : (missing + 1) & 3;
    pieces.points = 0;
    pieces.triangles = landed - 2;
    pieces.axis = axisOf(corner[a].wave.xyz);
    vec3 at[4];
    for (int i = 0; i < 4; ++i) {
        at[i] = turnedTo(pieces.axis, (corner[i].place.xyz + drift + 0.5) * float(surface.size.w));
        if (corner[i].event.x != uint(kStopped)) continue;
        Light more = lightAt(corner[i], pieces.share);
        pieces.light.power += more.power;
        pieces.light.flow += more.flow;
    }
    pieces.light = scaled(pieces.light, 1.0 / float(pieces.triangles));
    pieces.a = at[a];
    pieces.b = at[(a + 1) & 3];
    pieces.c = at[(a + 2) & 3];
    pieces.d = at[(a + 3) & 3];
    return pieces;
}

// Shifts a beam's points. One whose other wavelength went elsewhere goes as the others do in the mean.
void addDrifts(inout vec3 place[9], BeamNode node, float fine) {
#if DISPERSION == 1
    int all = 0;
    bool isKnown[9];
    vec3 drift[9];
    vec3 mean = vec3(0.0);
    for (int i = 0; i < 9; ++i) {
        int known = 0;
        drift[i] = driftOf(pointOf(node, i), known);
        isKnown[i] = known == 1;
        all += known;
        mean += drift[i];
    }
    mean /= float(max(all, 1));
    for (int i = 0; i < 9; ++i) place[i] += shift * fine * (isKnown[i] ? drift[i] : mean);
#endif
}

// A cell of a beam, one of `count` along its sides.
Pieces cellOf(BeamNode node, ivec2 cell, ivec2 count, float unit) {
    Pieces pieces = noPieces();
    pieces.triangles = 2;
    pieces.axis = axisOf(points[node.second.x].wave.xyz);
    float fine = float(surface.size.w);
    vec3 place[9]; // [fine voxel]
    vec3 weight[9];
#if SURFACE_FLOW == 1
    vec3 travel[9];
#endif
    for (int i = 0; i < 9; ++i) {
        BeamPoint point = points[pointOf(node, i)];
        place[i] = (point.place.xyz + 0.5) * fine;
        weight[i] = point.weight.xyz;
#if SURFACE_FLOW == 1
        travel[i] = directionOf(point);
#endif
    }
    addDrifts(place, node, fine);
    for (int i = 0; i < 9; ++i) place[i] = turnedTo(pieces.axis, place[i]);
    vec2 size = 1.0 / vec2(count);
    vec2 at = vec2(cell) * size;
    pieces.a = valueIn(place, at);
    pieces.b = valueIn(place, at + vec2(size.x, 0.0));
    pieces.c = valueIn(place, at + size);
    pieces.d = valueIn(place, at + vec2(0.0, size.y));
    vec3 power = 0.5 * unit * size.x * size.y * max(valueIn(weight, at + 0.5 * size), vec3(0.0));
#if SURFACE_FLOW == 1
    pieces.light = lightOf(power, normalize(valueIn(travel, at + 0.5 * size)), params.map.yzw);
#else
    pieces.light = Light(power, vec3(0.0));
#endif
    return pieces;
}

uint lay(Pieces pieces, inout float phase) {
    uint deposits = 0u;
    for (int i = 0; i < pieces.points; ++i) {
        BeamPoint point = points[pieces.point[i]];
        if (point.event.x != uint(kStopped)) continue;
        int known = 0;
        vec3 at = point.place.xyz + shift * driftOf(pieces.point[i], known);
        put(fineVoxelAt(at), axisOf(point.wave.xyz), lightAt(point, pieces.share), phase);
        ++deposits;
    }
    for (int i = 0; i < pieces.triangles; ++i)
        deposits += putTriangle(pieces.a, i == 0 ? pieces.b : pieces.c, i == 0 ? pieces.c : pieces.d, pieces.axis,
                                pieces.light, phase);
    return deposits;
}

void main() {
    uint item = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (gl_NumWorkGroups.x << 6);
    if (item >= params.list.x) return;
    // Those of beams come first, others from the list's end.
    uvec2 task = cells[item < params.list.y ? item : params.list.z - 1u - (item - params.list.y)];
    ivec2 cell = ivec2(task.y & 15u, task.y >> 4 & 15u);
    ivec2 count = ivec2(task.y >> 8 & 15u, task.y >> 12 & 15u) + 1;
    BeamNode node = nodes[task.x & 0x7FFFFFFFu];
    float edge = float(node.place.z) / float(params.levels.x);
    float unit = params.limits.z * edge * edge;
    uint which = uint(16 * cell.y + cell.x);
#if DISPERSION == 1
    int step = int(task.y >> 16 & 255u);
    int shifts = int(task.y >> 24);
    shift = shiftOf(step, shifts);
    unit /= float(1 << shifts);
    which ^= pcgHash(uint(step));
#endif
    uint place = pcgHash(uint(node.place.y) ^ pcgHash(256u * params.generation.z + which));
    float phase = uniformOf(pcgHash(uint(node.place.x) ^ place));
    Pieces pieces;
    if (task.x < 0x80000000u) pieces = cellOf(node, cell, count, unit);
    else if (node.state.x == 1u) // it came so from the interface before, and its middle is all there is
        pieces = onePoint(node.second.x, unit * uintBitsToFloat(node.state.z));
    else pieces = quarterOf(node, cell, unit);
    atomicAdd(counts[kDepositCount], lay(pieces, phase));
}
