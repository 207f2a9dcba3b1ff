// volsmooth: softens a scene volume, so that rays meet slopes where its voxels have edges.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/text.h"
#include "common/session.h"
#include "smooth/smooth.h"

using namespace eikonal;

namespace {

struct Options {
    std::string input, grids;
    volume::GridNames names;
    smooth::Params params;
};

void addOptions(CLI::App& app, Options& o) {
    app.add_option("input", o.input, "scene volume; - is standard input")
        ->type_name("IN.vdb")
        ->required();
    app.add_option("--sigma", o.params.sigma,
                   "standard deviation of the Gaussian [voxel]; 0 copies the volume")
        ->type_name("VOXELS")
        ->capture_default_str();
    app.add_option("--kernel", o.params.kernel,
                   "taps along each axis, an odd number (default: the next from 6 sigma on)")
        ->type_name("WIDTH");
    app.add_option("--grids", o.grids,
                   "float or vec3s grids to smooth (default: those of ior, opacity in the file, "
                   "and what varies of ior.NAME, within its object only); sdf or sdf.NAME: moves "
                   "the boundary, rounds its edges")
        ->type_name("NAME,...");
    tool::addGridNames(app, o.names, {"ior", "opacity", "sdf"});
}

std::string namesIn(const volume::Volume& volume) {
    std::vector<std::string> names;
    for (const volume::GridFacts& grid : volume.grids()) names.push_back(grid.name);
    return join(names, ", ");
}

void smoothVolume(tool::Session& session, Options& o) {
    o.params.automaticGrids = session.app().get_option("--grids")->empty();
    if (!o.params.automaticGrids) o.params.grids = split(o.grids, ',');
    for (const std::string& grid : o.params.grids) o.names.emplace(grid, grid); // part of the scene
    o.params.check();
    session.guardInputs({o.input});

    std::optional<volume::Volume> volume;
    smooth::Plan plan;
    session.pass("read", [&] {
        volume.emplace(volume::Volume::open(o.input, o.names));
        plan = smooth::makePlan(*volume, o.params);
    });
    if (session.explains()) {
        session.explain(
            plan.effects, {},
            {{"voxels", std::to_string(plan.size.x) + " x " + std::to_string(plan.size.y) + " x " +
                            std::to_string(plan.size.z)}});
        return;
    }
    session.stats().effects = plan.effects;
    AtomicFile& out = *session.outputs().at(0);
    if (!volume->holdsScene()) {
        session.warn(
            "nothing in " + volume->path() + " bends or bounds light (found: " + namesIn(*volume) +
            "): it is copied; other names are told by --grids NAME,... or --grid-ior NAME");
    } else if (plan.items.empty()) {
        session.note("nothing in " + volume->path() + " to smooth: it is copied");
    } else {
        const std::vector<smooth::Item> smoothed =
            smooth::run(session.device(), std::move(plan), session.stats(), session.progress());
        session.pass("grids", [&] {
            volume::PutOptions options;
            options.keepActive = true;
            for (const smooth::Item& item : smoothed) {
                options.background = item.background;
                if (item.object)
                    volume->putLevelSet(*item.object, volume->domain(), item.values,
                                        item.halfWidth);
                else
                    volume->put(item.grid, volume->domain(), item.values, options);
                if (!item.base) continue;
                volume::Law whole;
                whole.inDouble = true;
                whole.value = [base = *item.base](double value, int) { return base + value; };
                volume->derive(item.grid, item.grid, whole);
            }
        });
    }
    session.pass("write", [&] { volume->write(out, session.history()); });
}

} // namespace

int main(int argc, char** argv) {
    tool::Session session("volsmooth", "Smooths the grids of a scene volume that bend or bound "
                                       "light with a Gaussian; all else is copied.");
    Options options;
    addOptions(session.app(), options);
    return session.run(argc, argv, [&](tool::Session&) { smoothVolume(session, options); });
}
