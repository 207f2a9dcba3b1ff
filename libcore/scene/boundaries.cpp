// Objects' boundaries on the device, as shaders/transport/level_set.glsl reads them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/boundaries.h"

#include "scene/padded.h"
#include "scene/shared.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec4.hpp>
#include <tbb/parallel_for.h>

namespace eikonal::scene {

namespace {

using glm::ivec3;
using glm::vec3;

// From a voxel's centre to its corner [voxel].
constexpr float kVoxel = 0.8661f;

// The table of far voxels is made by blocks of this edge [voxel].
constexpr int kBlock = 2;

size_t placeOf(ivec3 size, int x, int y, int z) {
    return (static_cast<size_t>(z) * size.y + y) * size.x + x;
}

/// Texels of an object: texel (x, y, z) holds coefficients x − 2 … x + 1 of row (y − 2, z − 2),
/// from the first voxel of its box on.
ivec3 texelsOf(const Object& object) {
    return object.box.size() + ivec3(1, 4, 4);
}

/// What all objects take, one behind the other along z.
ivec3 texelsOf(const Scene& scene) {
    ivec3 all(0);
    for (const Object& object : scene.objects) {
        const ivec3 own = texelsOf(object);
        all = ivec3(std::max(all.x, own.x), std::max(all.y, own.y), all.z + own.z);
    }
    return all;
}

gpu::Texture makeDistances(gpu::Device& device, const Scene& scene) {
    gpu::Texture texture(device, texelsOf(scene), gpu::TexelFormat::rgba32f, gpu::Filter::nearest);
    const ivec3 all = texture.size();
    int slice = 0;
    for (const Object& object : scene.objects) {
        const std::vector<float> spline = coefficientsOf(object);
        const ivec3 outer = object.box.size() + 4, own = texelsOf(object);
        std::vector<float> texels(4 * static_cast<size_t>(all.x) * all.y);
        for (int z = 0; z < own.z; ++z, ++slice) {
            for (int y = 0; y < own.y; ++y) {
                const float* row = spline.data() + placeOf(outer, 0, y, z);
                float* out = texels.data() + 4 * static_cast<size_t>(y) * all.x;
                for (int x = 0; x < own.x; ++x, ++row, out += 4) std::copy(row, row + 4, out);
            }
            texture.uploadSlices(slice, 1, texels.data());
        }
    }
    return texture;
}

/// Padded pages, one behind the other along z, of the regions whose coefficients vary:
/// `pack(region, voxel, out)` fills a texel.
template<typename Pack>
gpu::Texture makePages(gpu::Device& device, const Scene& scene, bool floorAtZero,
                       const Pack& pack) {
    const ivec3 outer = scene.size() + 2;
    gpu::Texture texture(device, {outer.x, outer.y, outer.z * scene.varyingRegions()},
                         gpu::TexelFormat::rgba32f, gpu::Filter::linear);
    int slice = 0;
    for (const Region& region : scene.regions) {
        if (!region.coefficientsVary()) continue;
        std::vector<float> padded(4 * placeOf(outer, 0, 0, outer.z));
        size_t voxel = 0;
        for (int z = 0; z < scene.size().z; ++z)
            for (int y = 0; y < scene.size().y; ++y)
                for (int x = 0; x < scene.size().x; ++x)
                    pack(region, voxel++, padded.data() + 4 * placeOf(outer, x + 1, y + 1, z + 1));
        extendPadding(padded, scene.size(), 4, floorAtZero);
        texture.uploadSlices(slice, outer.z, padded.data());
        slice += outer.z;
    }
    return texture;
}

// Samples round an object's box that its spline is made from [voxel].
constexpr int kSplineMargin = 4;

/// The second difference of samples along an axis. Where walls are thin distances have a kink
/// between both faces, which is not theirs to bend by: there it is the lesser of the neighbours'.
float bendOf(const float* s, size_t stride) {
    const auto at = [&](int i) { return s[i * static_cast<std::ptrdiff_t>(stride)]; };
    const auto second = [&](int i) { return at(i - 1) - 2 * at(i) + at(i + 1); };
    const float own = second(0);
    const float kKink = 0.5f; // a ball of two voxels' radius has this
    if (std::abs(own) <= kKink) return own;
    const float before = second(-1), behind = second(1);
    const float least = std::abs(before) < std::abs(behind) ? before : behind;
    return std::abs(least) <= kKink ? least : 0.0f;
}

/// The box that all boundaries are in: a point of one is in a voxel whose centre is within kVoxel.
std::pair<vec3, vec3> boundsOf(const Scene& scene) {
    ivec3 low = scene.size(), high(-1);
    for (const Object& object : scene.objects) {
        size_t i = 0;
        for (int z = object.box.min.z; z <= object.box.max.z; ++z)
            for (int y = object.box.min.y; y <= object.box.max.y; ++y)
                for (int x = object.box.min.x; x <= object.box.max.x; ++x, ++i)
                    if (object.distance[i] < kVoxel) {
                        low = glm::min(low, ivec3(x, y, z));
                        high = glm::max(high, ivec3(x, y, z));
                    }
    }
    return {vec3(low) - 0.6f, vec3(high) + 0.6f}; // so that one on a face of it is within
}

/// One axis of an exact squared distance transform: the lower envelope of parabolas (Felzenszwalb
/// and Huttenlocher 2012, Theory of Computing 8:415).
void transformLine(float* line, size_t stride, int count, std::vector<float>& f,
                   std::vector<int>& v, std::vector<float>& z) {
    for (int i = 0; i < count; ++i) f[static_cast<size_t>(i)] = line[i * stride];
    int k = 0;
    v[0] = 0;
    z[0] = -1e20f;
    z[1] = 1e20f;
    const auto at = [&](int i) { return f[static_cast<size_t>(i)]; };
    for (int q = 1; q < count; ++q) {
        const auto meets = [&](int p) {
            return ((at(q) + static_cast<float>(q * q)) - (at(p) + static_cast<float>(p * p))) /
                   static_cast<float>(2 * (q - p));
        };
        float s = meets(v[static_cast<size_t>(k)]);
        while (s <= z[static_cast<size_t>(k)]) s = meets(v[static_cast<size_t>(--k)]);
        v[static_cast<size_t>(++k)] = q;
        z[static_cast<size_t>(k)] = s;
        z[static_cast<size_t>(k) + 1] = 1e20f;
    }
    k = 0;
    for (int q = 0; q < count; ++q) {
        while (z[static_cast<size_t>(k) + 1] < static_cast<float>(q)) ++k;
        const int p = v[static_cast<size_t>(k)];
        line[q * stride] = static_cast<float>((q - p) * (q - p)) + at(p);
    }
}

void transform(std::vector<float>& squares, ivec3 size) {
    const std::array<size_t, 3> strides{1, static_cast<size_t>(size.x),
                                        static_cast<size_t>(size.x) * size.y};
    for (int axis = 0; axis < 3; ++axis) {
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        tbb::parallel_for(0, size[b], [&](int j) {
            const auto count = static_cast<size_t>(size[axis]);
            std::vector<float> f(count), z(count + 1);
            std::vector<int> v(count);
            for (int i = 0; i < size[a]; ++i)
                transformLine(squares.data() + i * strides[static_cast<size_t>(a)] +
                                  j * strides[static_cast<size_t>(b)],
                              strides[static_cast<size_t>(axis)], size[axis], f, v, z);
        });
    }
}

/// How far a block's centre is from that of the nearest block that a boundary may pass [block].
struct Blocks {
    ivec3 size;
    std::vector<float> distance;
};

Blocks farBlocks(ivec3 size, const std::vector<float>& nearest) {
    Blocks blocks{(size + kBlock - 1) / kBlock, {}};
    blocks.distance.assign(placeOf(blocks.size, 0, 0, blocks.size.z), 1e12f);
    size_t i = 0;
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x, ++i)
                if (nearest[i] <= kVoxel)
                    blocks.distance[placeOf(blocks.size, x / kBlock, y / kBlock, z / kBlock)] = 0;
    transform(blocks.distance, blocks.size);
    for (float& d : blocks.distance) d = std::sqrt(d);
    return blocks;
}

/// How far a voxel's centre is from the farthest point for which it is the nearest one, less what a
/// filtered look-up makes good: half a voxel across each of the domain's faces that it lies on.
float wayToFace(ivec3 voxel, ivec3 size) {
    int faces = 0;
    for (int axis = 0; axis < 3; ++axis) faces += voxel[axis] == 0 || voxel[axis] == size[axis] - 1;
    return 0.5f * static_cast<float>(faces);
}

/// Whether a sample in an edge or corner of its box is as near to boundaries on all of the box's
/// faces there: an edge of the object, where differences of distances tell no slope. `inner` is
/// the distance a voxel further in from all those faces.
bool isEdge(ivec3 p, ivec3 size, float distance, float inner, const vec3& rise) {
    int faces = 0;
    for (int axis = 0; axis < 3; ++axis) faces += p[axis] == 0 || p[axis] == size[axis] - 1;
    const vec3 steep = glm::abs(rise);
    return faces > 1 && std::abs(distance) < kVoxel && std::abs(distance - inner) > 0.5f &&
           std::max({steep.x, steep.y, steep.z}) < 0.5f;
}

} // namespace

std::vector<float> coefficientsOf(const Object& object) {
    // Beyond its box an object's distances go on linearly: it ends there only where the domain
    // does.
    const ivec3 size = object.box.size(), outer = size + 2 * kSplineMargin;
    std::vector<float> values(placeOf(outer, 0, 0, outer.z));
    const auto at = [&](ivec3 q) { return object.distance[placeOf(size, q.x, q.y, q.z)]; };
    const auto sample = [&](ivec3 p) {
        const ivec3 in = glm::clamp(p, ivec3(0), size - 1);
        ivec3 side(0); // of the faces that `in` is on
        for (int axis = 0; axis < 3; ++axis)
            side[axis] = (in[axis] == size[axis] - 1) - (in[axis] == 0);
        const auto behind = [&](ivec3 step) {
            return at(glm::clamp(in - step, ivec3(0), size - 1));
        };
        vec3 rise(0); // outward, over a voxel
        for (int axis = 0; axis < 3; ++axis) {
            ivec3 step(0);
            step[axis] = side[axis] == 0 ? 1 : side[axis];
            rise[axis] = at(in) - behind(step);
        }
        const vec3 beyond(glm::abs(p - in));
        return at(in) + (isEdge(in, size, at(in), behind(side), rise)
                             ? std::copysign(std::max({beyond.x, beyond.y, beyond.z}), -at(in))
                             : glm::dot(beyond, rise));
    };
    tbb::parallel_for(0, outer.z, [&](int z) {
        for (int y = 0; y < outer.y; ++y)
            for (int x = 0; x < outer.x; ++x)
                values[placeOf(outer, x, y, z)] = sample(ivec3(x, y, z) - kSplineMargin);
    });
    // c = s − δ²s/6 along each axis: cubics through their samples, but for fourth differences.
    const ivec3 inner = size + 4;
    const std::array<size_t, 3> strides{1, static_cast<size_t>(outer.x),
                                        static_cast<size_t>(outer.x) * outer.y};
    std::vector<float> result(placeOf(inner, 0, 0, inner.z));
    tbb::parallel_for(0, inner.z, [&](int z) {
        for (int y = 0; y < inner.y; ++y)
            for (int x = 0; x < inner.x; ++x) {
                const int in = kSplineMargin - 2;
                const float* s = values.data() + placeOf(outer, x + in, y + in, z + in);
                float c = *s;
                for (size_t stride : strides) c -= bendOf(s, stride) / 6;
                result[placeOf(inner, x, y, z)] = c;
            }
    });
    return result;
}

BoundaryTable tabulate(const Scene& scene) {
    const ivec3 size = scene.size();
    const bool alone = scene.objects.size() == 1;
    BoundaryTable table;
    table.clearance.assign(placeOf(size, 0, 0, size.z), 1e9f);
    table.objects.assign(table.clearance.size(), 0);
    std::vector<float>& nearest = table.clearance;
    for (size_t k = 0; k < scene.objects.size(); ++k) {
        const Object& object = scene.objects[k];
        const ivec3 own = object.box.size();
        const float beyond = std::min(object.band, kKept);
        tbb::parallel_for(0, size.z, [&](int z) {
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) {
                    const ivec3 p = ivec3(x, y, z) - object.box.min;
                    const bool in = p == glm::clamp(p, ivec3(0), own - 1);
                    const float d = in ? object.distance[placeOf(own, p.x, p.y, p.z)] : beyond;
                    const size_t i = placeOf(size, x, y, z);
                    nearest[i] = std::min(nearest[i], std::abs(d));
                    if (d < 0) table.objects[i] |= 1u << k;
                    if (std::abs(d) < kNearby) table.objects[i] |= 1u << (16 + k);
                }
        });
    }
    const Blocks blocks = farBlocks(size, nearest);
    // From a voxel to its block's centre, to that of a block with a boundary, to a voxel of it
    // whose centre is within kVoxel of the boundary.
    const float slack = (2 * (kBlock - 1) + 1) * kVoxel;
    tbb::parallel_for(0, size.z, [&](int z) {
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const size_t i = placeOf(size, x, y, z);
                const size_t block = placeOf(blocks.size, x / kBlock, y / kBlock, z / kBlock);
                nearest[i] = std::max(nearest[i], kBlock * blocks.distance[block] - slack);
                nearest[i] = std::max(nearest[i] - wayToFace({x, y, z}, size), 0.0f);
                if (alone && (table.objects[i] & 1u)) nearest[i] = -nearest[i];
            }
    });
    return table;
}

Boundaries::Boundaries(gpu::Device& device, const Scene& scene) {
    SceneParams values{};
    const ivec3 texels = texelsOf(scene);
    values.texel = vec4(1.0f / vec3(texels), 0);
    values.voxel = vec4(1.0f / vec3(scene.size()), 0);
    const auto [low, high] = boundsOf(scene);
    values.low = vec4(low, 0);
    values.high = vec4(high, 0);
    int slice = 0;
    for (size_t k = 0; k < scene.objects.size(); ++k) {
        const Object& object = scene.objects[k];
        values.objects[k] = {vec4(vec3(object.box.min), slice),
                             vec4(vec3(object.box.size() - 1), 0)};
        slice += texelsOf(object).z;
    }
    const auto h = static_cast<float>(scene.voxelSize());
    const ivec3 page = scene.size() + 2;
    int pages = 0;
    values.page =
        vec4(1.0f / vec3(page.x, page.y, page.z * std::max(scene.varyingRegions(), 1)), 0);
    for (size_t r = 0; r < scene.regions.size(); ++r) {
        const Region& region = scene.regions[r];
        const bool varies = region.coefficientsVary();
        values.regions[r] = paramsOf(region, h, varies ? static_cast<float>(page.z * pages++) : -1);
    }
    mParams = gpu::Buffer(device, sizeof values, &values);
    if (pages > 0) makeCoefficients(device, scene, h);
    mDistances = makeDistances(device, scene);
    const BoundaryTable table = tabulate(scene);
    mClearance = gpu::Texture(device, scene.size(), gpu::TexelFormat::r32f, gpu::Filter::linear);
    mClearance.upload(table.clearance.data());
    if (scene.objects.size() == 1) return;
    mNearby = gpu::Texture(device, scene.size(), gpu::TexelFormat::r32ui, gpu::Filter::nearest);
    mNearby.upload(table.objects.data());
}

void Boundaries::makeCoefficients(gpu::Device& device, const Scene& scene, float h) {
    const auto rgb = [h](const Values& values, size_t voxel, float* out) {
        for (int c = 0; c < 3; ++c) out[c] = values.at(voxel, c) * h;
    };
    mCoefficients[0] = makePages(device, scene, false, [&](const Region& r, size_t i, float* out) {
        rgb(r.absorption, i, out);
        out[3] = r.anisotropy.at(i, 0);
    });
    mCoefficients[1] = makePages(device, scene, true, [&](const Region& r, size_t i, float* out) {
        rgb(r.scattering, i, out);
    });
    mCoefficients[2] = makePages(device, scene, true, [&](const Region& r, size_t i, float* out) {
        rgb(r.emission, i, out);
    });
}

void Boundaries::bind() const {
    mParams.bindUniform(kSceneBlock);
    mDistances.bindSampler(kDistancesUnit);
    mClearance.bindSampler(kClearanceUnit);
    for (unsigned i = 0; i < 3; ++i)
        if (mCoefficients[i].name() != 0) mCoefficients[i].bindSampler(kAbsorptionsUnit + i);
    if (mNearby.name() != 0) mNearby.bindSampler(kNearbyUnit);
}

std::vector<gpu::Need> boundaryNeeds(const Scene& scene) {
    const ivec3 texels = texelsOf(scene), page = scene.size() + 2;
    const std::int64_t pages = scene.varyingRegions();
    return {{"coefficients that vary", std::int64_t{page.x} * page.y * page.z * pages * 48, false,
             page.z * static_cast<int>(pages)},
            {"the boundaries' distances", std::int64_t{texels.x} * texels.y * texels.z * 16, false,
             std::max({texels.x, texels.y, texels.z})},
            {"the table of boundaries",
             std::int64_t{scene.size().x} * scene.size().y * scene.size().z *
                 (scene.objects.size() == 1 ? 4 : 8),
             false, std::max({scene.size().x, scene.size().y, scene.size().z})}};
}

} // namespace eikonal::scene
