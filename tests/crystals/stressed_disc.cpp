// stressed_disc: makes a disc's material birefringent as two forces along z would that compress it.
//   stressed_disc DISC.vdb OUT.vdb RADIUS BIREFRINGENCE
// The disc lies across the y axis; BIREFRINGENCE is n along σ1 less n along σ2 in its middle.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/atomic_file.h"
#include "base/error.h"
#include "base/text.h"
#include "support/photoelastic.h"
#include "volume/volume.h"

#include <cstdio>
#include <glm/vec4.hpp>

namespace {

using namespace eikonal;

// Of a force on a line the stress has no end; a real one presses on a face.
constexpr double kMost = 0.0095;

void stress(const std::string& in, const std::string& out, double radius, double birefringence) {
    volume::Volume volume = volume::Volume::open(in);
    const std::string name = volume.objects().at(0).name;
    const float n = volume.constant(volume::ownGrid("ior", name)).value().x;
    const double middle = discStress({0, 0}, radius).difference;
    const volume::IndexBox box = volume.domain();
    const glm::ivec3 size = box.size();
    volume::DenseGrid axis{size, 3, {}}, extraordinary{size, 1, {}};
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const glm::dvec4 at =
                    volume.frame().worldFromIndex * glm::dvec4(box.min + glm::ivec3(x, y, z), 1);
                const PlaneStress here = discStress({at.x, at.z}, radius);
                for (const double a : {here.first.x, 0.0, here.first.y})
                    axis.values.push_back(static_cast<float>(a));
                extraordinary.values.push_back(static_cast<float>(
                    n + std::min(birefringence * here.difference / middle, kMost)));
            }
    volume.put(volume::ownGrid("axis", name), box, axis, {});
    volume::PutOptions options;
    options.background = glm::vec3(n);
    volume.put(volume::ownGrid("ior_extraordinary", name), box, extraordinary, options);
    AtomicFile file(out);
    volume.write(file, {"stressed_disc", "1", "stressed_disc"});
    file.commit();
}

} // namespace

int main(int argc, char** argv) {
    try {
        const auto radius = argc == 5 ? parseNumbers(argv[3]) : std::nullopt,
                   birefringence = argc == 5 ? parseNumbers(argv[4]) : std::nullopt;
        if (!radius || !birefringence || radius->size() != 1 || birefringence->size() != 1) {
            std::fprintf(stderr, "stressed_disc: error: expected DISC.vdb OUT.vdb RADIUS "
                                 "BIREFRINGENCE\n");
            return 64;
        }
        stress(argv[1], argv[2], radius->front(), birefringence->front());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "stressed_disc: error: %s\n", error.what());
        return 65;
    }
    return 0;
}
