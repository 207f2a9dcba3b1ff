// What surrounds the objects, as mesh2vol's command line describes it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/session.h"
#include "mesh2vol/materials.h"
#include "voxelize/params.h"

namespace eikonal::mesh2vol {

/// What surrounds the objects, as given; a value that was not is its material's.
struct Medium {
    std::string material = kNone;
    std::optional<double> abbe;
    voxelize::Material values;
    CLI::Option *ior = nullptr, *dispersion = nullptr, *absorption = nullptr;
};

inline void addMediumOptions(CLI::App& app, Medium& m) {
    voxelize::Material& medium = m.values;
    const std::string group = "Surrounding medium";
    app.add_option("--medium-material", m.material, "a name, as of --material")
        ->type_name("NAME")
        ->capture_default_str()
        ->group(group);
    m.ior = app.add_option("--medium-ior", medium.ior, "refractive index")
                ->type_name("N")
                ->capture_default_str()
                ->group(group);
    m.dispersion = app.add_option("--medium-dispersion", medium.dispersion, "Cauchy B [µm²]")
                       ->type_name("B")
                       ->capture_default_str()
                       ->group(group);
    app.add_option("--medium-abbe", m.abbe, "Abbe number, 0: no dispersion")
        ->type_name("V")
        ->excludes(m.dispersion)
        ->group(group);
    const std::string rgb = "or one number ";
    m.absorption =
        tool::addVector(app, "--medium-absorption", medium.absorption, rgb + "[1/unit]", true)
            ->type_name("R,G,B")
            ->group(group);
    tool::addVector(app, "--medium-scattering", medium.scattering, rgb + "[1/unit]", true)
        ->type_name("R,G,B")
        ->group(group);
    app.add_option("--medium-anisotropy", medium.anisotropy, "Henyey-Greenstein g")
        ->type_name("G")
        ->capture_default_str()
        ->group(group);
    tool::addVector(app, "--medium-emission", medium.emission, rgb + "[radiance/unit]", true)
        ->type_name("R,G,B")
        ->group(group);
}

/// Throws UsageError.
inline voxelize::Material mediumOf(const Medium& medium, const std::optional<double>& unit) {
    voxelize::Material m = medium.values;
    if (const auto* material = materialOf("--medium-material", medium.material)) {
        if (medium.ior->count() == 0) m.ior = material->ior;
        if (medium.dispersion->count() == 0) m.dispersion = material->dispersion;
        if (medium.absorption->count() == 0) m.absorption = absorptionOf(*material, unit);
    }
    if (medium.abbe) m.dispersion = dispersionBy("--medium-abbe", *medium.abbe, m.ior);
    return m;
}

} // namespace eikonal::mesh2vol
