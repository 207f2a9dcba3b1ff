// View rays: what a setting costs, and how far its rays end from where they should.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fields.h"
#include "gpu/device.h"
#include "rows.h"

namespace accuracy {

/// What every part is given.
struct Bench {
    eikonal::gpu::Device& device;
    std::string work;
    bool full = true;
    Json version; ///< library, device: goes into every key
};

/// A way to trace rays, view rays and photons alike.
struct Setting {
    eikonal::optics::Tracing tracing;
    int maxDepth = 8; ///< sharp: most boundaries that a ray meets; in no name and no key
    std::string name() const;
    Json key() const;
};

Setting fixed(const std::string& integrator, const std::string& interpolation, double step,
              bool plainSamples = false);
Setting adaptive(double tolerance, double step = 0, const std::string& interpolation = "cubic");
/// The sources' scheme, which all others are measured by.
Setting sources();
/// What `render` does unless told otherwise.
Setting usual();

/// Where a picture's rays ended.
struct Ends {
    std::vector<dvec3> place, direction; ///< world [unit]
    std::vector<double> optical, drift;  ///< [unit], and | |w| − n | there
    double viewMs = 0, steps = 0, rays = 0, trapped = 0;
    double noted = 0; ///< adaptive: the worst error that the tracer itself reckons with [voxel]
};

/// A field as voxels, ready to be looked into.
class Stage {
public:
    explicit Stage(eikonal::scene::Files scene);
    Ends ends(Bench& bench, const eikonal::view::Camera& camera, const Setting& setting,
              int maxSteps = 0) const;
    /// GPU time of the view pass without AOVs [ms].
    double time(Bench& bench, const eikonal::view::Camera& camera, const Setting& setting) const;

private:
    eikonal::scene::Files mScene;
    eikonal::view::Plan mPlan;
};

/// The last stage asked for, made anew when another field or size is wanted.
const Stage& stageOf(const Field& field, int voxels);

/// Root mean square and worst over the rays, from the judge's ends.
struct Deviation {
    double rms = 0, worst = 0; ///< of the place [unit]
    double mrad = 0;           ///< rms of the direction [mrad]
    double optical = 0;        ///< rms of the optical path length [unit]
};
Deviation deviation(const Ends& found, const Ends& wanted);
/// The judge's ends of the field's rays.
const Ends& truthOf(const Field& field, int pixels);

constexpr int kErrorPixels = 64;

std::vector<Task> rayTasks(Bench& bench);

/// How errors fall with the step and with the voxels, and whether they stay bounded.
std::vector<Task> orderTasks(Bench& bench);

/// A ball of glass, its edge blurred and sharp.
std::vector<Task> sharpTasks(Bench& bench);

/// Sharp boundaries against the judge, one number a bar.
std::vector<Task> glassTasks(Bench& bench);

/// A voxelised ball: smoothing width, supersampling, voxels.
std::vector<Task> chainTasks(Bench& bench);

/// Photons: fluence against converged runs and against paper.
std::vector<Task> lightTasks(Bench& bench);

} // namespace accuracy
