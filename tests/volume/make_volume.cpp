// make_volume: small analytic scene volumes for tests, written through the volume room.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// make_volume OUT.vdb [SETTING ...] GRID SHAPE [GRID SHAPE ...]
//   settings: size=X,Y,Z [voxel]  voxel=H [unit]  centre=X,Y,Z [unit]  turn=DEGREES (about Y)
//   GRID      name or name=BACKGROUND (r,g,b for a vector); a contract name has its own type, any
//             other is a vector where it begins with "v_", else a scalar
//   SHAPE     constant:V            sphere:RADIUS:IN:OUT         box:HALF_EDGE:IN:OUT
//             linear:V:DX,DY,DZ     delta:X,Y,Z:V                luneburg:RADIUS
//             rod:N0:G              (n² = n0² (1 − g² (x² + y²)), a GRIN rod along z)
//             ball:RADIUS           (its signed distance)
// V, IN, OUT are values (r,g,b for a vector), lengths in units from the volume's centre, a delta's
// place a voxel from the corner. Voxels that differ from the background are active; with
// "all" behind the shape ("sphere:1:1.5:1:all") every voxel is.
#include "base/error.h"
#include "base/text.h"
#include "volume/volume.h"

#include <algorithm>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <iostream>

using namespace eikonal;
using glm::dvec3;

namespace {

struct Scene {
    glm::ivec3 size{32};
    double voxel = 1;
    dvec3 centre{0};
    double turn = 0;
};

std::vector<double> numbers(const std::string& text, size_t least, size_t most) {
    const auto values = parseNumbers(text);
    if (!values || values->size() < least || values->size() > most)
        throw UsageError("found '" + text + "', expected numbers");
    return *values;
}

dvec3 vectorOf(const std::string& text) {
    const auto v = numbers(text, 1, 3);
    return v.size() == 3 ? dvec3(v[0], v[1], v[2]) : dvec3(v[0]);
}

double numberOf(const std::string& text) {
    return numbers(text, 1, 1)[0];
}

/// The shape as a function of the place [unit] from the volume's centre, and of the voxel.
std::function<dvec3(dvec3, glm::ivec3)> shapeOf(const std::vector<std::string>& parts) {
    const std::string& kind = parts[0];
    const auto arguments = [&](size_t count) {
        if (parts.size() != count + 1)
            throw UsageError(kind + " takes " + std::to_string(count) + " arguments");
    };
    if (kind == "constant") {
        arguments(1);
        return [v = vectorOf(parts[1])](dvec3, glm::ivec3) { return v; };
    }
    if (kind == "sphere" || kind == "box") {
        arguments(3);
        const bool round = kind == "sphere";
        return [=, r = numberOf(parts[1]), in = vectorOf(parts[2]),
                out = vectorOf(parts[3])](dvec3 x, glm::ivec3) {
            const dvec3 a = glm::abs(x);
            return (round ? glm::length(x) : std::max({a.x, a.y, a.z})) < r ? in : out;
        };
    }
    if (kind == "linear") {
        arguments(2);
        return [v = vectorOf(parts[1]), slope = vectorOf(parts[2])](dvec3 x, glm::ivec3) {
            return v + glm::dot(slope, x);
        };
    }
    if (kind == "delta") {
        arguments(2);
        return [place = glm::ivec3(vectorOf(parts[1])), v = vectorOf(parts[2])](
                   dvec3, glm::ivec3 voxel) { return voxel == place ? v : dvec3(0); };
    }
    if (kind == "luneburg") {
        arguments(1);
        return [r = numberOf(parts[1])](dvec3 x, glm::ivec3) {
            return dvec3(std::sqrt(2 - std::min(glm::dot(x, x) / (r * r), 1.0)));
        };
    }
    if (kind == "ball") {
        arguments(1);
        return [r = numberOf(parts[1])](dvec3 x, glm::ivec3) { return dvec3(glm::length(x) - r); };
    }
    if (kind == "rod") {
        arguments(2);
        return [n0 = numberOf(parts[1]), g = numberOf(parts[2])](dvec3 x, glm::ivec3) {
            return dvec3(n0 * std::sqrt(std::max(1 - g * g * (x.x * x.x + x.y * x.y), 0.01)));
        };
    }
    throw UsageError("no shape '" + kind + "'");
}

void addGrid(volume::Volume& out, const Scene& scene, const std::string& grid, std::string shape) {
    volume::PutOptions options;
    if (shape.size() > 4 && shape.ends_with(":all")) {
        options.allActive = true;
        shape.resize(shape.size() - 4);
    }
    const size_t equals = grid.find('=');
    const std::string name = grid.substr(0, equals);
    const std::vector<std::string> parts = split(shape, ':');
    const std::vector<std::string> vectors = {"absorption",     "scattering", "emission",
                                              "albedo",         "fluence",    "reflectance",
                                              "light_direction"};
    const bool isVector = std::find(vectors.begin(), vectors.end(), name) != vectors.end() ||
                          (name.rfind("v_", 0) == 0);
    if (equals != std::string::npos)
        options.background = glm::vec3(vectorOf(grid.substr(equals + 1)));
    else if (name == "ior" || name == "reflectance")
        options.background = glm::vec3(1);
    const auto value = shapeOf(parts);
    volume::DenseGrid dense;
    dense.size = scene.size;
    dense.components = isVector ? 3 : 1;
    for (int z = 0; z < scene.size.z; ++z)
        for (int y = 0; y < scene.size.y; ++y)
            for (int x = 0; x < scene.size.x; ++x) {
                const glm::ivec3 voxel(x, y, z);
                const dvec3 place = (dvec3(voxel) - 0.5 * dvec3(scene.size - 1)) * scene.voxel;
                const dvec3 v = value(place, voxel);
                for (int c = 0; c < dense.components; ++c)
                    dense.values.push_back(static_cast<float>(v[c]));
            }
    out.put(name, {glm::ivec3(0), scene.size - 1}, dense, options);
}

void make(const std::vector<std::string>& words) {
    Scene scene;
    size_t next = 1;
    for (; next < words.size(); ++next) {
        const size_t equals = words[next].find('=');
        const std::string key = words[next].substr(0, equals);
        if (equals == std::string::npos) break;
        const std::string value = words[next].substr(equals + 1);
        if (key == "size")
            scene.size = glm::ivec3(vectorOf(value));
        else if (key == "voxel")
            scene.voxel = numberOf(value);
        else if (key == "centre")
            scene.centre = vectorOf(value);
        else if (key == "turn")
            scene.turn = numberOf(value);
        else
            break;
    }
    if (next >= words.size() || (words.size() - next) % 2 != 0)
        throw UsageError("expected OUT.vdb [SETTING ...] GRID SHAPE [GRID SHAPE ...]");
    volume::Frame frame;
    frame.voxelSize = scene.voxel;
    frame.worldFromIndex =
        glm::translate(glm::dmat4(1), scene.centre) *
        glm::rotate(glm::dmat4(1), glm::radians(scene.turn), dvec3(0, 1, 0)) *
        glm::translate(glm::dmat4(1), -0.5 * scene.voxel * dvec3(scene.size - 1)) *
        glm::scale(glm::dmat4(1), dvec3(scene.voxel));
    volume::Volume out(frame);
    for (; next + 1 < words.size(); next += 2) addGrid(out, scene, words[next], words[next + 1]);
    AtomicFile file(words[0]);
    out.write(file, {"make_volume", "test", "make_volume " + baseName(words[0])});
    file.commit();
}

} // namespace

int main(int argc, char** argv) {
    try {
        const std::vector<std::string> words(argv + 1, argv + argc);
        if (words.empty()) throw UsageError("no output given");
        make(words);
        return 0;
    } catch (const Error& error) {
        std::cerr << "make_volume: error: " << error.what() << "\n";
        return static_cast<int>(error.status());
    }
}
