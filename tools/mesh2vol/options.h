// mesh2vol's command line, and the scene it describes.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/error.h"
#include "base/text.h"
#include "common/session.h"
#include "mesh2vol/ground.h"
#include "mesh2vol/medium.h"
#include "voxelize/params.h"

#include <deque>
#include <limits>

namespace eikonal::mesh2vol {

/// An option of an object as given: once for all or several times.
struct PerMesh {
    std::string option;
    std::vector<std::string> given{};
};

struct Options {
    std::vector<std::string> meshes;
    std::deque<PerMesh> perMesh; // a deque, for CLI11 keeps addresses
    Medium medium;
    GroundOptions ground;
    std::optional<double> unit; // [m]
    std::string bounds, boundary = "sharp";
    double voxelSize = 0;
    CLI::Option* voxelSizeOption = nullptr;
    bool repair = false;
    voxelize::Params params;

    const std::vector<std::string>& given(const std::string& option) const {
        for (const PerMesh& candidate : perMesh)
            if (candidate.option == option) return candidate.given;
        throw InternalError("no option " + option);
    }
};

inline CLI::Option* addPerMesh(CLI::App& app, Options& o, const std::string& option,
                               const std::string& type, const std::string& help) {
    o.perMesh.push_back({option});
    return app.add_option(option, o.perMesh.back().given, help)
        ->type_name(type)
        ->allow_extra_args(false)
        ->group("Objects (given once for all, once for each mesh, or once for each object in them, "
                "in their order; none: not for that one)");
}

inline void addObjectOptions(CLI::App& app, Options& o) {
    addPerMesh(app, o, "--material", "NAME",
               "index, dispersion and, by --unit, absorption, where they are not given: " +
                   join(optics::materialNames(), ", "));
    addPerMesh(
        app, o, "--ior", "N",
        "refractive index at 587.6 nm; of what is opaque that of its coat, if it is above that "
        "of what surrounds it");
    addPerMesh(app, o, "--dispersion", "B", "Cauchy B [µm²] (default 0)");
    addPerMesh(app, o, "--abbe", "V",
               "instead of --dispersion: the Abbe number (n_d - 1) / (n_F - n_C), 1 to 1000; 0: "
               "no dispersion");
    addPerMesh(app, o, "--absorption", "R,G,B", "or one number [1/unit] (default 0)");
    addPerMesh(app, o, "--scattering", "R,G,B", "or one number [1/unit] (default 0)");
    addPerMesh(app, o, "--anisotropy", "G", "Henyey-Greenstein g in (-1, 1) (default 0)");
    addPerMesh(app, o, "--emission", "R,G,B", "or one number [radiance/unit] (default 0)");
    addPerMesh(app, o, "--opacity", "A", "1: the viewing ray stops inside (default 0)");
    addPerMesh(app, o, "--albedo", "R,G,B", "of what is opaque, or one number (default 0)");
    addPerMesh(app, o, "--reflectance", "R,G,B",
               "tint of the mirror reflection, or one number (default 1)");
    addPerMesh(app, o, "--roughness", "A",
               "of the boundary: GGX's alpha, 0 (smooth, the default) to 1");
    addPerMesh(app, o, "--ior-extraordinary", "N",
               "of a uniaxial crystal, by --axis: n_e, while --ior is n_o");
    addPerMesh(app, o, "--axis", "X,Y,Z",
               "a crystal's optic axis, of length 1; 0,0,0: as if it were isotropic, by n_o");
    addPerMesh(app, o, "--absorption-extraordinary", "R,G,B",
               "of its light polarised along the axis, or one number [1/unit] (default as "
               "--absorption, which is of light across it)");
    addPerMesh(app, o, "--dispersion-extraordinary", "B",
               "Cauchy B of n_e [µm²] (default that of n_o)");
    addPerMesh(app, o, "--metal", "NAME",
               "an opaque mirror: " + join(optics::metalNames(), ", ") + "; it needs no --ior");
    addPerMesh(app, o, "--priority", "INT",
               "the higher wins where objects overlap, among equals the later (default 0)");
    addPerMesh(app, o, "--fill-below", "yes|no",
               "an open mesh that ends at the faces of --bounds or beyond is filled below (-Y) "
               "rather than behind its faces (default no)");
    addPerMesh(
        app, o, "--name", "NAME",
        "for messages and grids: sdf.NAME, ior.NAME (default: the file's; FILE.NAME where OBJ "
        "names several objects)");
}

inline void addOptions(CLI::App& app, Options& o) {
    voxelize::Params& p = o.params;
    app.add_option(
           "mesh", o.meshes,
           "closed surfaces, or open ones that end at the faces of --bounds or beyond: OBJ, PLY, "
           "OFF, STL or glTF; - is standard input. What glTF and the .mtl of an OBJ say of matter "
           "holds where no option says other")
        ->type_name("MESH")
        ->required();
    addObjectOptions(app, o);
    addMediumOptions(app, o.medium);
    addGroundOptions(app, o.ground);
    const std::string group = "Volume";
    app.add_option("--unit", o.unit,
                   "metres in a unit of the meshes, by which named materials absorb; without it "
                   "they do not")
        ->type_name("METRES")
        ->group(group);
    auto* resolution = app.add_option("--resolution", p.resolution,
                                      "voxels along the longest edge, padding included")
                           ->type_name("N")
                           ->capture_default_str()
                           ->group(group);
    o.voxelSizeOption = app.add_option("--voxel-size", o.voxelSize, "edge of a voxel [unit]")
                            ->type_name("S")
                            ->excludes(resolution)
                            ->group(group);
    auto* padding = app.add_option("--padding", p.padding,
                                   "voxels around the meshes, on all sides; default: " +
                                       std::to_string(voxelize::kUsualPadding) +
                                       ", but a quarter of --resolution at most")
                        ->type_name("VOXELS")
                        ->group(group);
    app.add_option("--bounds", o.bounds, "the domain [unit], instead of meshes and padding")
        ->type_name("X0,Y0,Z0,X1,Y1,Z1")
        ->excludes(padding)
        ->group(group);
    app.add_flag("--cube", p.cube, "pad to the same number of voxels along every axis")
        ->group(group);
    app.add_option("--supersample", p.supersample, "samples along a voxel's edge: 1, 2, 4 or 8")
        ->type_name("S")
        ->capture_default_str()
        ->group(group);
    app.add_flag("--repair", o.repair,
                 "where needed join points within 1e-5 of the mesh's diagonal, close holes and "
                 "turn faces outward; a mesh that this would make another object is refused")
        ->group(group);
    app.add_option("--smooth", p.smooth,
                   "facets that meet at no more than so many degrees are curved, by the normals of "
                   "OBJ and PLY where they fit, and refined to a twentieth of a voxel; 0: none")
        ->type_name("DEG")
        ->capture_default_str()
        ->group(group);
    app.add_option("--boundary", o.boundary,
                   "sharp: also write each object's signed distance (sdf, or sdf.NAME of several) "
                   "and its values unmixed (ior.NAME ...), so that rays refract at the boundary "
                   "itself; blurred: only the mixed grids")
        ->type_name("sharp|blurred")
        ->capture_default_str()
        ->group(group);
    app.add_option("--sdf-band", p.sdfBand, "half width of the distances' band, 4 or more [voxel]")
        ->type_name("VOXELS")
        ->capture_default_str()
        ->group(group);
}

/// The scene's parameters, all but the objects. Throws UsageError.
inline voxelize::Params sceneOf(const Options& o) {
    voxelize::Params params = o.params;
    if (o.unit && !(*o.unit >= 1e-9 && *o.unit <= 1e9))
        throw UsageError("--unit: found " + toText(*o.unit) + ", expected 1e-9 to 1e9 metres");
    params.medium = mediumOf(o.medium, o.unit);
    if (o.boundary != "sharp" && o.boundary != "blurred")
        throw UsageError("--boundary: found '" + o.boundary + "', expected sharp or blurred");
    params.sharp = o.boundary == "sharp";
    params.ground = groundOf(o.ground);
    params.groundMargin = o.ground.margin;
    if (o.voxelSizeOption->count() > 0) params.voxelSize = o.voxelSize;
    if (!o.bounds.empty()) {
        const auto b = parseNumbers(o.bounds);
        if (!b || b->size() != 6)
            throw UsageError("--bounds: found '" + o.bounds +
                             "', expected six numbers X0,Y0,Z0,X1,Y1,Z1");
        params.bounds = mesh::Box{{(*b)[0], (*b)[1], (*b)[2]}, {(*b)[3], (*b)[4], (*b)[5]}};
    }
    return params;
}

} // namespace eikonal::mesh2vol
