// sim2vol: makes a scene volume of what a simulation wrote, by stated laws.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/text.h"
#include "common/session.h"
#include "optics/air.h"
#include "optics/spectrum.h"
#include "simgrids/simgrids.h"
#include "volume/contract.h"

using namespace eikonal;

namespace {

struct Options {
    std::string input, kelvin, ambient;
    std::map<std::string, std::string> from; ///< by target
};

std::string helpOf(const std::string& target) {
    if (target == "ior")
        return "the refractive index at 587.6 nm, stored in double. gladstone-dale: 1 + K x of a "
               "density x [kg/m³] (default K: dry air's, " +
               toText(
                   static_cast<float>(optics::gladstoneDaleOfAir(optics::kReferenceWavelength))) +
               " m³/kg). air: that of dry air at a temperature x [K] and PRESSURE [Pa] (default: " +
               toText(optics::kStandardPressure) + "), by Ciddor 1996. Or SCALE x + OFFSET";
    if (target == "sdf") return "signed distance [unit] of a level set: SCALE x";
    const volume::GridRule& rule = *volume::ruleFor(target);
    const bool vector = rule.type == volume::GridType::vector;
    return "SCALE x + OFFSET" + std::string(vector ? ", each one number or R,G,B" : "") +
           "; valid: " + rule.wanted;
}

void addOptions(CLI::App& app, Options& o) {
    app.add_option("input", o.input, "a simulation's grids; - is standard input")
        ->type_name("IN.vdb")
        ->required();
    for (const std::string& target : simgrids::targets()) {
        const std::string type = target == "ior"   ? "GRID:gladstone-dale[:K] | GRID:air[:PRESSURE]"
                                                     " | GRID:SCALE[:OFFSET]"
                                 : target == "sdf" ? "GRID:SCALE"
                                                   : "GRID:SCALE[:OFFSET]";
        app.add_option("--" + target + "-from", o.from[target], helpOf(target))->type_name(type);
    }
    app.add_option("--kelvin", o.kelvin,
                   "what makes kelvins of the temperature x of --ior-from GRID:air: SCALE x + "
                   "OFFSET (default 1:0)")
        ->type_name("SCALE[:OFFSET]");
    app.add_option("--ambient", o.ambient,
                   "temperature of the air where that grid has no active voxel [K] (default: by "
                   "its background)")
        ->type_name("KELVIN");
    app.footer("Without --...-from: scattering is density and emission is flame (Houdini, "
               "Blender), where they are, or heat beside temperature (older Houdini); x 1, per "
               "unit of length.\n"
               "Names: a GRID that is not there is looked for under another name: temperature as "
               "heat, flame as flames or burn, vel as velocity. So Houdini's density, temperature, "
               "heat, fuel, vel and Blender's density, temperature or heat, flame, fuel, color, "
               "velocity are found. A grid of vectors (color, vel) makes grids of vectors, "
               "component by component.\n"
               "All other grids are copied. Grids that are read must lie on one transform.");
}

double numberOf(const std::string& option, const std::string& text, const std::string& expected) {
    const std::optional<double> value = parseNumber(text);
    if (!value) throw UsageError(option + ": found '" + text + "', expected " + expected);
    return *value;
}

simgrids::Params paramsOf(const CLI::App& app, const Options& o) {
    simgrids::Params params;
    for (const std::string& target : simgrids::targets())
        if (!app.get_option("--" + target + "-from")->empty())
            params.maps.push_back(simgrids::parseMap(target, o.from.at(target)));
    if (!app.get_option("--kelvin")->empty()) {
        const std::vector<std::string> parts = split(o.kelvin, ':');
        const std::string expected = "SCALE[:OFFSET], numbers";
        if (parts.size() > 2)
            throw UsageError("--kelvin: found '" + o.kelvin + "', expected " + expected);
        params.kelvinScale = numberOf("--kelvin", parts[0], expected);
        if (parts.size() == 2) params.kelvinOffset = numberOf("--kelvin", parts[1], expected);
    }
    if (!app.get_option("--ambient")->empty())
        params.ambient = numberOf("--ambient", o.ambient, "a temperature [K]");
    params.check();
    return params;
}

void makeVolume(tool::Session& session, const Options& o) {
    const simgrids::Params params = paramsOf(session.app(), o);
    session.guardInputs({o.input});
    std::optional<simgrids::Plan> plan;
    session.pass("read", [&] { plan.emplace(simgrids::makePlan(o.input, params)); });
    session.stats().effects = plan->effects;
    if (session.explains()) {
        const glm::ivec3 size = plan->volume.domain().size();
        session.explain(plan->effects, {},
                        {{"voxels", std::to_string(size.x) + " x " + std::to_string(size.y) +
                                        " x " + std::to_string(size.z)}});
        return;
    }
    AtomicFile& out = *session.outputs().at(0);
    session.pass("grids", [&] {
        for (const std::string& warning : simgrids::run(*plan, params, session.stats()))
            session.warn(warning);
    });
    session.pass("write", [&] { plan->volume.write(out, session.history()); });
}

} // namespace

int main(int argc, char** argv) {
    tool::Session session("sim2vol", "Makes a scene volume of a simulation's grids (smoke, fire, "
                                     "hot air) by stated laws; all else is copied.");
    Options options;
    addOptions(session.app(), options);
    return session.run(argc, argv, [&](tool::Session&) { makeVolume(session, options); });
}
