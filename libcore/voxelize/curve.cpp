// Objects' facets become the curved surfaces that they stand for.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxelize/curve.h"

#include "mesh/smooth_surface.h"
#include "voxelize/plan.h"

namespace eikonal::voxelize {

std::vector<std::string> curveObjects(Params& params, Stats& stats) {
    std::vector<std::string> warnings;
    for (const Object& object : params.objects)
        stats.count("triangles_read", static_cast<double>(object.mesh.triangles.size()));
    if (params.smooth == 0) {
        for (Object& object : params.objects) object.mesh.normals.clear();
        return warnings;
    }
    const double sagitta = mesh::kSagitta * voxelSizeOf(params);
    std::vector<const mesh::TriangleMesh*> meshes;
    std::vector<mesh::Fans> fans;
    for (const Object& object : params.objects) {
        meshes.push_back(&object.mesh);
        fans.push_back(mesh::findFans(object.mesh, params.smooth));
    }
    if (meshes.size() > 1) mesh::joinFans(meshes, fans, params.smooth);
    for (size_t k = 0; k < fans.size(); ++k) {
        Object& object = params.objects[k];
        mesh::SmoothCounts counts;
        object.mesh = mesh::curved(object.mesh, fans[k], sagitta, counts);
        if (counts.flat == 0) continue;
        stats.count("triangles_left_flat", static_cast<double>(counts.flat));
        warnings.push_back("'" + object.name + "': " + std::to_string(counts.flat) +
                           (counts.flat == 1 ? " triangle stays" : " triangles stay") +
                           " flat: curved by --smooth, the surface would cross itself there");
    }
    return warnings;
}

} // namespace eikonal::voxelize
