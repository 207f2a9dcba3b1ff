// The ground of a scene, and the lights that fall on it beyond the domain.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/ground.h"

#include "base/error.h"

namespace eikonal::scene {

std::optional<Ground> readGround(const Files& files, const Scene& scene) {
    std::optional<Ground> ground;
    for (const volume::Volume* volume : files.all()) {
        const auto plane = volume::groundOf(*volume);
        if (!plane) continue;
        if (ground && !(ground->plane == *plane))
            throw DataError(volume->path() + ": its ground is " + volume::textOf(*plane) +
                            ", expected that of the files before, " +
                            volume::textOf(ground->plane));
        if (!ground) ground = Ground{*plane, {}};
    }
    if (!ground) return ground;
    if (files.isMoved())
        throw DataError(files.path() + ": has a ground, " + volume::textOf(ground->plane) +
                        ", and is moved, expected what has a ground to stay where it is");
    ground->lights = recordedLights(files);
    ground->low = glm::dvec3(-0.5);
    ground->high = glm::dvec3(scene.size()) - 0.5;
    for (size_t k = 0; k < scene.objects.size(); ++k)
        if (scene.regions[k].name == volume::kGround) ground->region = static_cast<int>(k);
    return ground;
}

} // namespace eikonal::scene
