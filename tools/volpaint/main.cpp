// volpaint: changes what a volume is made of by noise, brushes, and other volumes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/text.h"
#include "common/placement.h"
#include "common/session.h"
#include "paint/paint.h"

using namespace eikonal;

namespace {

struct Options {
    std::string input, object;
    std::vector<std::string> noises, spheres, stamps;
};

void addOptions(CLI::App& app, Options& o) {
    app.add_option("input", o.input, "scene volume; - is standard input")
        ->type_name("IN.vdb")
        ->required();
    const auto repeated = [&](const std::string& name, std::vector<std::string>& into,
                              const std::string& form, const std::string& help) {
        app.add_option(name, into, help)->type_name(form)->allow_extra_args(false);
    };
    repeated("--noise", o.noises, "GRID:AMOUNT:SIZE[:OCTAVES[:SEED]]",
             "multiplies the grid by 1 + AMOUNT x noise from -1 to 1, whose coarsest features are "
             "SIZE [unit] apart (default 4 octaves, seed 0); by 0 where that is negative");
    repeated(
        "--sphere", o.spheres, "GRID:X,Y,Z:RADIUS:VALUE[:SOFT]",
        "adds VALUE, one number or R,G,B, within a sphere [unit]; it fades over the outer SOFT "
        "(0 to 1, default 0.5) of the radius");
    repeated(
        "--stamp", o.stamps, "BRUSH.vdb:TX,TY,TZ[:RX,RY,RZ[:S]]",
        "adds absorption, scattering and emission of another volume, scaled by S, turned about "
        "X, then Y, then Z [degree], shifted [unit]");
    app.add_option(
           "--object", o.object,
           "a GRID without a dot is this object's own, GRID.NAME; medium: of what surrounds "
           "all objects")
        ->type_name("NAME");
    app.footer("GRID: " + join(paint::paintable(), ", ") +
               ", or of a file with sharp objects GRID.NAME. Noises come first, then spheres, then "
               "stamps; options may be given again. All else is copied, light too: run lightsim "
               "behind it.\n"
               "Example: volpaint water.vdb -o dyed.vdb --object water --stamp ink.vdb:0,-0.2,0");
}

void paintVolume(tool::Session& session, const Options& o) {
    paint::Params params;
    params.object = o.object;
    for (const std::string& text : o.noises) params.noises.push_back(paint::parseNoise(text));
    for (const std::string& text : o.spheres) params.spheres.push_back(paint::parseSphere(text));
    std::vector<std::string> inputs = {o.input};
    for (const std::string& text : o.stamps) {
        const tool::Placement place = tool::parsePlacement(text, true, "--stamp");
        params.stamps.push_back({place.name, place.worldFromOwn});
        inputs.push_back(place.name);
    }
    params.check();
    // The same brush may be given again, but not from standard input.
    session.guardInputs(inputs);
    std::optional<volume::Volume> volume;
    session.pass("read", [&] { volume.emplace(volume::Volume::open(o.input)); });
    if (session.explains()) {
        const glm::ivec3 size = volume->domain().size();
        session.explain({}, {},
                        {{"voxels", std::to_string(size.x) + " x " + std::to_string(size.y) +
                                        " x " + std::to_string(size.z)},
                         {"strokes", std::to_string(params.noises.size() + params.spheres.size() +
                                                    params.stamps.size())}});
        return;
    }
    AtomicFile& out = *session.outputs().at(0);
    session.pass("paint", [&] {
        for (const std::string& warning : paint::run(*volume, params, session.stats()))
            session.warn(warning);
    });
    session.pass("write", [&] { volume->write(out, session.history()); });
}

} // namespace

int main(int argc, char** argv) {
    tool::Session session("volpaint", "Changes what a scene volume is made of: noise in its "
                                      "coefficients, soft brushes, other volumes added in.");
    Options options;
    addOptions(session.app(), options);
    return session.run(argc, argv, [&](tool::Session&) { paintVolume(session, options); });
}
