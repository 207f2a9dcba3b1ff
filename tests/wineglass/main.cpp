// Says how far a picture's rays through the wine glass are from the exact ones; see
// pipelines/wineglass.mk. SPDX-License-Identifier: GPL-3.0-or-later
#include "image/exr.h"
#include "wineglass/compare.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>

int main(int argc, char** argv) {
    std::string profile, aovs;
    std::vector<double> eye, target;
    wineglass::Setting setting;
    CLI::App app("Compares render's rays with those through the exact surface.", "wineglass");
    app.add_option("profile", profile, "what profile.awk prints")->required();
    app.add_option("aovs", aovs, "EXR with exit_position and exit_direction")->required();
    app.add_option("--eye", eye, "as render's")->required()->expected(3)->delimiter(',');
    app.add_option("--target", target, "as render's")->required()->expected(3)->delimiter(',');
    app.add_option("--fov", setting.camera.fov, "as render's [degree]")->required();
    app.add_option("--voxel", setting.voxel, "edge of a voxel [mm]")->required();
    app.add_option("--ior", setting.glass.index, "of the glass");
    CLI11_PARSE(app, argc, argv);
    try {
        std::ifstream in(profile);
        setting.glass = judge::readProfile(in, setting.glass.index);
        const eikonal::image::Image picture = eikonal::image::readExr(aovs);
        setting.camera.eye = {eye[0], eye[1], eye[2]};
        setting.camera.target = {target[0], target[1], target[2]};
        setting.camera.width = picture.width;
        setting.camera.rows = picture.height;
        const auto all = wineglass::compare(setting, picture);
        std::printf("%-16s %7s %8s %8s   %-28s %-28s %s\n", "rays", "told", "left out", "close",
                    "degrees: median, 99 %, worst", "voxels: median, 99 %, worst", "set aside");
        for (size_t k = 0; k < all.size(); ++k) {
            const wineglass::Errors& errors = all[k];
            const auto three = [](const std::vector<double>& values) {
                char text[64];
                std::snprintf(text, sizeof text, "%.2g, %.2g, %.2g",
                              wineglass::quantile(values, 0.5), wineglass::quantile(values, 0.99),
                              wineglass::quantile(values, 1));
                return std::string(text);
            };
            std::printf("%-16s %7d %8d %7.2f%%   %-28s %-28s %.2g mm\n", wineglass::kCourses[k],
                        errors.rays, errors.leftOut,
                        errors.rays ? 100.0 * errors.close / errors.rays : 0.0,
                        three(errors.degrees).c_str(), three(errors.apart).c_str(), errors.set);
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "wineglass: error: %s\n", error.what());
        return 65;
    }
    return 0;
}
