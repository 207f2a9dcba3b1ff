// Exact pictures of lit floors, and how far others are from them; see pipelines/caustic_compare.mk.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "caustic/compare.h"
#include "image/exr.h"

#include <CLI/CLI.hpp>
#include <cstdio>

namespace {

void writeExact(const std::string& scene, judge::View view, double irradiance,
                const std::string& path) {
    judge::Floor floor;
    judge::Picture picture;
    if (scene == "ball") {
        picture = judge::pictureOf(judge::BallOverPlane{}, floor, view);
    } else {
        judge::Water water;
        water.boxLow = {-0.5, 0.2, -0.3}, water.boxHigh = {-0.1, 0.3, 0.1};
        floor.extent = 2, floor.fine = 512;
        picture = judge::pictureOf(water, floor, view);
    }
    eikonal::AtomicFile out(path);
    eikonal::image::writeExr(caustic::imageOf(picture, view, irradiance), {}, out);
    out.commit();
}

} // namespace

int main(int argc, char** argv) {
    std::string scene, path, exact, picture;
    std::vector<double> eye, target;
    std::vector<int> size;
    judge::View view;
    double irradiance = 1;
    CLI::App app("Exact pictures of lit floors, and how far others are from them.", "caustic");
    app.require_subcommand(1);
    auto* make = app.add_subcommand("exact", "writes the exact picture");
    make->add_option("scene", scene, "ball or water")
        ->required()
        ->check(CLI::IsMember({"ball", "water"}));
    make->add_option("-o", path, "EXR to write")->required();
    make->add_option("--eye", eye, "as render's")->required()->expected(3)->delimiter(',');
    make->add_option("--target", target, "as render's")->required()->expected(3)->delimiter(',');
    make->add_option("--fov", view.fov, "as render's [degree]")->required();
    make->add_option("--size", size, "as render's")->required()->expected(2)->delimiter('x');
    make->add_option("--irradiance", irradiance, "of the light, across its direction");
    auto* compare = app.add_subcommand(
        "compare",
        "prints the error, how many pixels are within 5 %, and the energy, on the floor and on "
        "what is seen through");
    compare->add_option("picture", picture, "EXR")->required();
    compare->add_option("exact", exact, "EXR that `exact` wrote")->required();
    CLI11_PARSE(app, argc, argv);
    try {
        if (*make) {
            view.eye = {eye[0], eye[1], eye[2]};
            view.target = {target[0], target[1], target[2]};
            view.width = size[0], view.rows = size[1];
            writeExact(scene, view, irradiance, path);
            return 0;
        }
        const auto found = eikonal::image::readExr(picture),
                   wanted = eikonal::image::readExr(exact);
        for (const auto& [name, meets] : {std::pair("floor", judge::Meets::floor),
                                          std::pair("through", judge::Meets::through)}) {
            const caustic::Errors errors = caustic::errorsOf(found, wanted, meets);
            if (errors.pixels)
                std::printf("%s: error %.2f %%, within 5 %% %.2f %%, energy %+.2f %%\n", name,
                            100 * errors.error, 100 * errors.within, 100 * errors.energy);
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "caustic: error: %s\n", error.what());
        return 65;
    }
    return 0;
}
