// What the light stage is asked to do.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "optics/tracing.h"
#include "scene/lights.h"

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace eikonal::lightsim {

using scene::Light;
using scene::parseLight;
using scene::powerOf;

/// A number of photons as written by people (1e6). Throws UsageError if it is not whole, below 1 or
/// above 2^40.
std::int64_t photonCount(double number);

enum class Output : unsigned { none = 0, fluence = 1, direction = 2, both = 3, irradiance = 4 };

constexpr Output operator|(Output a, Output b) {
    return static_cast<Output>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}

/// Three corners a triangle, outward, in the world [unit].
using Triangles = std::vector<glm::dvec3>;

/// How light is carried: to surfaces by beams and through volumes by photons, all by one of
/// them, or to surfaces by beams and through volumes by wavefronts.
enum class Method { automatic, photons, beams, wavefront };

/// Throws UsageError.
Method parseMethod(const std::string& name);

/// Points of opaque surfaces that a picture shows, row by row, in the world.
struct Points {
    int width = 0;                  ///< of the picture [pixel]
    std::vector<glm::dvec3> places; ///< [unit]
    std::vector<glm::vec3> normals; ///< outward, of any length; 0: no point
    bool empty() const { return places.empty(); }
};

/// One of them in voxel space.
struct PointOnSurface {
    glm::vec3 place{0};
    glm::vec3 normal{0}; ///< of length 1; 0: no point
};

/// How often a cell of a light's map is split at most.
constexpr int kMostBeamLevels = 4;

/// Most sources that may stand for an extended light.
constexpr int kMostLightSamples = 1 << 14;

/// A patch of a wavefront in the world.
struct FrontQuad {
    std::array<glm::dvec3, 4> corners; ///< one after the other round it [unit]
    glm::dvec3 power{0};               ///< that goes through it, rgb [W]
    bool singleRay = false;            ///< too small to have an area
};

/// Is told the front of a part of a light's map after each step of time, from 1 on.
using FrontSink = std::function<void(int step, const std::vector<FrontQuad>& front)>;

struct Params {
    Method method = Method::automatic;
    optics::Tracing tracing; ///< its step caps the octree's; 0: no cap
    std::vector<Light> lights;
    int lightSamples = 0;           ///< sources that stand for an extended light; 0: automatic
    std::int64_t photons = 0;       ///< pixels of each light's photon map; 0: by the voxels
    double octreeTolerance = 0.005; ///< ε: index range within which a leaf counts as constant [1]
    double octreeTolerance2 = 0.02; ///< ε': range within which a leaf limits the step [1]
    double stepLimit = 8;           ///< longest step in such a leaf [voxel]
    double stepMin = 1;             ///< shortest step [voxel]
    int surfaceDetail = 0;      ///< fine voxels along an edge of a voxel; 0: as many as is worth it
    double beamError = 1.0 / 3; ///< how far a beam's middle may be off [surface voxel]
    int beamLevels = kMostBeamLevels; ///< a cell of a light's map is split so often at most
    double shadowCull = 1;            ///< a cell of which so much leads nowhere is not split
    double beamCutoff = 1e-3;     ///< a kind of path is not followed below this share of its light
    int bounces = 0;              ///< times that opaque surfaces send light on
    int maxDepth = 64;            ///< sharp: most boundaries that a photon meets
    int maxSteps = 1 << 16;       ///< of one photon, after which it counts as trapped
    double dropBelow = 1e-5;      ///< a photon is dropped at this share of its first power
    double thinTo = 0.001;        ///< tracing ends when this share of the photons is left
    int smoothing = 1;            ///< rounds of 3×3×3 smoothing of the result
    bool automaticOutputs = true; ///< what a render of the file needs; else `outputs`
    Output outputs = Output::both;
    std::uint32_t seed = 0;   ///< shifts the photon maps by part of a pixel
    Points points;            ///< surfaces receive light for these alone
    bool lightsApart = false; ///< points: of each light, too
    Triangles proxy;          ///< photons start on it instead of on the domain's faces
    FrontSink seeFront;       ///< with wavefronts

    /// Throws UsageError naming the option that is wrong.
    void check() const;
};

} // namespace eikonal::lightsim
