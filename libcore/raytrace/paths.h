// Paths of viewing rays through bodies: refraction, reflection, absorption, to every order.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "camera/irradiance.h"
#include "image/image.h"
#include "raytrace/faces.h"
#include "raytrace/params.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace eikonal::raytrace {

/// How often each clear body's surface winds around a point.
using Windings = std::array<std::uint8_t, kMostClearBodies>;

/// The first branch of a pixel's ray, which refracts wherever it can, to where it left the bodies.
struct FirstPath {
    glm::dvec3 x{0};          ///< where it last left a body, or met an opaque one; else the eye
    glm::dvec3 direction{0};  ///< there, of length 1
    glm::dvec3 normal{0};     ///< of the opaque surface that it ended on, towards it; 0: none
    glm::dvec3 through{1};    ///< what absorption and boundaries leave of its light; 0 if it ended
    double length = 0;        ///< within bodies [unit]
    double opticalLength = 0; ///< the same, by index [unit]
    bool changed = false;     ///< it met anything
};

/// What rays met, summed up.
struct Counters {
    double rays = 0;       ///< that met a body
    double interfaces = 0; ///< met
    double deep = 0;       ///< shares of light that had met too many interfaces
    double dim = 0;        ///< shares dropped because nothing worth following was left
    double lost = 0;       ///< shares of light that left a clear body through no face of it

    void operator+=(const Counters& other);
};

/// The scene as paths meet it. Questions may be asked by many threads.
class Scene {
public:
    /// All three must outlive it. Throws UsageError for too many clear bodies.
    Scene(const std::vector<Body>& bodies, const Params& params,
          const std::optional<image::Image>& map);

    /// Which bodies hold a point.
    Windings windingsAt(const glm::dvec3& x) const;

    /// Radiance that arrives at `eye`, which lies within what `windings` says, against a unit
    /// direction [W/(m² sr)].
    glm::dvec3 radiance(const glm::dvec3& eye, const glm::dvec3& direction,
                        const Windings& windings, FirstPath& first, Counters& counters) const;

    /// Whether something absorbs one colour more than another.
    bool coloured() const;

private:
    struct Branch;
    struct Work;
    struct Medium {
        double ior;
        glm::dvec3 absorption;
        int body; ///< of the list; kNone: what is around the bodies
    };
    static constexpr int kNone = -1;

    Medium mediumIn(const Windings& windings) const;
    bool step(Branch& branch, Work& work) const;
    bool part(Branch& branch, Work& work, const Windings& beyond,
              const struct SurfacePoint& point) const;
    void land(const Branch& branch, Work& work, const Body& body, const glm::dvec3& normal) const;
    void seeBeyond(const Branch& branch, Work& work) const;

    const std::vector<Body>& mBodies;
    const Params& mParams;
    const std::optional<image::Image>& mMap;
    std::vector<int> mPlace; ///< of each body in Windings; kNone: it is opaque
    Faces mFaces;
    camera::Irradiance mIrradiance{}; ///< where something is opaque
};

} // namespace eikonal::raytrace
