// Wavefronts as files: a mesh of quads for every step of time.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/error.h"
#include "common/session.h"
#include "lightsim/params.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <glm/geometric.hpp>
#include <map>

/// Keeps the fronts of all lights, step by step, and writes them as DIR/front_0001.ply and so on.
class FrontFiles {
public:
    /// Makes the folder, if there is none. Throws CreateError.
    explicit FrontFiles(const std::string& folder) : mFolder(folder) {
        std::error_code error;
        std::filesystem::create_directories(folder, error);
        if (!std::filesystem::is_directory(folder))
            throw eikonal::CreateError(folder + ": can't create the folder, expected by "
                                                "--dump-fronts");
    }

    void add(int step, const std::vector<eikonal::lightsim::FrontQuad>& front) {
        std::vector<Quad>& quads = mSteps[step];
        for (const eikonal::lightsim::FrontQuad& quad : front)
            if (!quad.singleRay) quads.push_back(packed(quad));
    }

    void write(eikonal::tool::Session& session) const {
        for (const auto& [step, quads] : mSteps) {
            std::array<char, 32> name{};
            std::snprintf(name.data(), name.size(), "/front_%04d.ply", step);
            eikonal::AtomicFile& file = session.extraOutput(mFolder + name.data());
            write(file.stream(), quads);
            file.finish();
        }
    }

private:
    /// Corners [unit], then power [W] and irradiance [W/m²], the means of rgb.
    struct Quad {
        std::array<float, 12> corners;
        float power, irradiance;
    };

    static Quad packed(const eikonal::lightsim::FrontQuad& quad) {
        Quad out{};
        for (size_t k = 0; k < 4; ++k)
            for (int i = 0; i < 3; ++i)
                out.corners[3 * k + static_cast<size_t>(i)] =
                    static_cast<float>(quad.corners[k][i]);
        const double power = (quad.power.x + quad.power.y + quad.power.z) / 3;
        const double area = 0.5 * glm::length(glm::cross(quad.corners[2] - quad.corners[0],
                                                         quad.corners[3] - quad.corners[1]));
        out.power = static_cast<float>(power);
        out.irradiance = area > 0 ? static_cast<float>(power / area) : 0;
        return out;
    }

    static void write(std::ostream& out, const std::vector<Quad>& quads) {
        out << "ply\nformat binary_little_endian 1.0\n"
            << "element vertex " << 4 * quads.size() << "\n"
            << "property float x\nproperty float y\nproperty float z\n"
            << "element face " << quads.size() << "\n"
            << "property list uchar int vertex_indices\n"
            << "property float power\nproperty float irradiance\nend_header\n";
        const auto put = [&out](const auto& value) {
            out.write(reinterpret_cast<const char*>(&value), sizeof value);
        };
        for (const Quad& quad : quads) put(quad.corners);
        for (size_t i = 0; i < quads.size(); ++i) {
            put(static_cast<unsigned char>(4));
            for (size_t k = 0; k < 4; ++k) put(static_cast<std::int32_t>(4 * i + k));
            put(quads[i].power);
            put(quads[i].irradiance);
        }
    }

    std::string mFolder;
    std::map<int, std::vector<Quad>> mSteps;
};
