// What meshgen can make: a subcommand each.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinds.h"

#include "base/text.h"
#include "common/session.h"
#include "mesh/check.h"
#include "mesh/read.h"
#include "shapes/brilliant.h"
#include "shapes/flecks.h"
#include "shapes/implicit.h"
#include "shapes/logo.h"
#include "shapes/revolve.h"
#include "shapes/solids.h"
#include "shapes/wave.h"

#include <memory>

namespace eikonal::meshgen {

namespace {

using mesh::TriangleMesh;

CLI::App* addCommand(CLI::App& app, const std::string& name, const std::string& what,
                     const std::string& example) {
    CLI::App* command = app.add_subcommand(name, what);
    command->fallthrough(); // so that -o may come behind
    command->get_formatter()->column_width(34);
    command->footer("Example: meshgen " + name + " " + example +
                    "\nmeshgen --help has the options of all kinds.");
    return command;
}

template<typename Value>
CLI::Option* add(CLI::App* command, const std::string& name, Value& value, const std::string& type,
                 const std::string& help) {
    return command->add_option(name, value, help)->type_name(type)->capture_default_str();
}

/// A kind whose mesh is made of its params alone.
template<typename Params, typename Make>
Kind plain(CLI::App* command, const std::shared_ptr<Params>& params, const Make& make) {
    return {command,
            [params, make](std::uint32_t) {
                params->check();
                return make(*params);
            },
            [] { return std::vector<std::string>(); }, [] { return false; }};
}

Kind addRevolve(CLI::App& app) {
    struct Options {
        std::string profile;
        shapes::RevolveParams params;
    };
    const auto o = std::make_shared<Options>();
    CLI::App* c =
        addCommand(app, "revolve", "a profile turned round the y axis", "bowl.csv -o bowl.obj");
    c->add_option(
         "profile", o->profile,
         "a table, a radius and a height a line (a comma or blanks between; # begins a "
         "comment), or an SVG drawing, whose first path or polyline counts: x is the "
         "radius, the height is above its lowest point. An end off the axis is closed by a "
         "disc; a loop makes a ring. - is standard input")
        ->type_name("PROFILE.csv|svg")
        ->required();
    add(c, "--segments", o->params.segments, "N", "around the axis");
    add(c, "--tolerance", o->params.tolerance, "UNITS",
        "how far chords of a drawing's curves may be off [unit]; 0: a two-thousandth of its "
        "extent");
    return {c,
            [o](std::uint32_t) {
                o->params.check();
                return shapes::revolve(shapes::readProfile(o->profile, o->params.tolerance),
                                       o->params);
            },
            [o] { return std::vector{o->profile}; }, [] { return false; }};
}

std::string bodiesHelp() {
    std::string help;
    for (const shapes::ImplicitBody& body : shapes::implicitBodies())
        help += (help.empty() ? "" : "; ") + body.name + ": " + body.meaning;
    return help;
}

Kind addImplicit(CLI::App& app) {
    const auto params = std::make_shared<shapes::ImplicitParams>();
    CLI::App* c = addCommand(app, "implicit", "a body that a function of space bounds",
                             "gyroid --cells 3 -o gyroid.obj");
    c->add_option("name", params->name, bodiesHelp())->type_name("NAME")->required();
    add(c, "--resolution", params->resolution, "CELLS", "along the body's longest side");
    std::map<std::string, std::string> knobs;
    for (const shapes::ImplicitBody& body : shapes::implicitBodies())
        for (const shapes::Knob& knob : body.knobs)
            knobs[knob.name] += (knobs[knob.name].empty() ? "" : "; ") + body.name + ": " +
                                knob.meaning + ", " + toText(knob.least) + " to " +
                                toText(knob.most) + " (default " + toText(knob.value) + ")";
    for (const auto& [knob, help] : knobs)
        c->add_option_function<double>(
             "--" + knob, [params, name = knob](double value) { params->set[name] = value; }, help)
            ->type_name("NUMBER");
    return {c,
            [params](std::uint32_t seed) {
                params->seed = seed;
                params->check();
                return shapes::makeImplicit(*params);
            },
            [] { return std::vector<std::string>(); }, [] { return false; }};
}

Kind addBrilliant(CLI::App& app) {
    const auto p = std::make_shared<shapes::BrilliantParams>();
    CLI::App* c = addCommand(app, "brilliant", "a gem in the round brilliant cut, lying on a facet",
                             "--table 57 -o stone.obj");
    add(c, "--radius", p->radius, "UNITS", "of the girdle [unit]");
    add(c, "--table", p->table, "PERCENT", "width of the table [% of the diameter]");
    add(c, "--crown", p->crown, "DEG", "angle of the upper main facets [degree]");
    add(c, "--pavilion", p->pavilion, "DEG", "angle of the lower main facets [degree]");
    add(c, "--girdle", p->girdle, "PERCENT", "height of the girdle [% of the diameter]");
    add(c, "--star", p->star, "PERCENT",
        "how far star facets reach from the table's edge to the girdle");
    add(c, "--lower", p->lower, "PERCENT",
        "how far lower girdle facets reach from the girdle to the axis");
    add(c, "--culet", p->culet, "PERCENT", "width of the culet [% of the diameter]");
    c->add_flag("--upright", p->upright, "the axis along y, the girdle about y = 0");
    return plain(c, p, shapes::makeBrilliant);
}

Kind addPrism(CLI::App& app) {
    const auto p = std::make_shared<shapes::PrismParams>();
    CLI::App* c = addCommand(app, "prism", "a prism along z about the origin, a corner at the top",
                             "--side 0.7 --length 0.68 -o prism.obj");
    add(c, "--sides", p->sides, "N", "of the regular polygon");
    add(c, "--side", p->side, "UNITS", "length of a side, with --angle of the base [unit]");
    add(c, "--length", p->length, "UNITS", "along z [unit]");
    c->add_option("--angle", p->apex,
                  "of a triangle between its two equal sides [degree] (default: 60)")
        ->type_name("DEG");
    return plain(c, p, shapes::makePrism);
}

Kind addBox(CLI::App& app) {
    const auto p = std::make_shared<shapes::BoxParams>();
    CLI::App* c = addCommand(app, "box", "a box between two corners",
                             "--from=-2,-0.1,-2 --to 2,0,2 -o table.obj");
    tool::addVector(*c, "--from", p->low, "a corner [unit] (default -0.5,-0.5,-0.5)");
    tool::addVector(*c, "--to", p->high, "the opposite corner [unit] (default 0.5,0.5,0.5)");
    add(c, "--bevel", p->bevel, "UNITS", "radius of its edges and corners [unit]");
    add(c, "--segments", p->segments, "N", "of a bevel, a quarter of a turn; even");
    return plain(c, p, shapes::makeBox);
}

Kind addSphere(CLI::App& app) {
    const auto p = std::make_shared<shapes::SphereParams>();
    CLI::App* c =
        addCommand(app, "sphere", "a sphere about the origin", "--radius 0.5 -o ball.obj");
    add(c, "--radius", p->radius, "UNITS", "[unit]");
    add(c, "--segments", p->segments, "N", "around, half as many from pole to pole; even");
    return plain(c, p, shapes::makeSphere);
}

Kind addLogo(CLI::App& app) {
    const auto p = std::make_shared<shapes::LogoParams>();
    CLI::App* c = addCommand(app, "logo", "words as solid letters along x, upright on y = 0",
                             "Glass --depth 0.4 -o glass.obj");
    c->add_option("text", p->text, "one line, in UTF-8")->type_name("TEXT")->required();
    add(c, "--font", p->font, "FILE", "TrueType, OpenType or another that FreeType reads");
    add(c, "--height", p->height, "UNITS", "of a capital letter [unit]");
    add(c, "--depth", p->depth, "UNITS", "of the letters, along z [unit]");
    add(c, "--tolerance", p->tolerance, "SHARE",
        "how far chords of the letters' curves may be off [height of a capital letter]");
    Kind kind = plain(c, p, shapes::makeLogo);
    kind.inputs = [p] { return std::vector{p->font}; };
    return kind;
}

Kind addWave(CLI::App& app) {
    const auto p = std::make_shared<shapes::WaveParams>();
    CLI::App* c = addCommand(app, "wave",
                             "the surface of water with three waves about y = 0, a sheet for "
                             "mesh2vol --fill-below",
                             "--time 0.5 --bottom=-0.5 -o water.obj");
    add(c, "--half", p->half, "UNITS", "half its width along x and z [unit]");
    add(c, "--squares", p->squares, "N", "of its mesh, each way");
    add(c, "--height", p->height, "FACTOR", "of the waves: 1 has slopes up to 0.44");
    add(c, "--time", p->time, "SECONDS", "how far they have travelled, a unit being a metre [s]");
    c->add_option("--bottom", p->bottom, "closes it by walls and a floor there [unit]")
        ->type_name("Y");
    Kind kind = plain(c, p, shapes::makeWave);
    kind.isOpen = [p] { return !p->bottom; };
    return kind;
}

Kind addFlecks(CLI::App& app) {
    struct Options {
        std::string within;
        shapes::FlecksParams params;
    };
    const auto o = std::make_shared<Options>();
    shapes::FlecksParams& p = o->params;
    CLI::App* c = addCommand(app, "flecks",
                             "many small ellipsoids at random places wholly within a body (--seed)",
                             "bunny.off --count 60 --radius 0.03 -o flecks.obj");
    c->add_option("within", o->within, "the body, a closed mesh; - is standard input")
        ->type_name("MESH")
        ->required();
    add(c, "--count", p.count, "N", "how many");
    add(c, "--radius", p.radius, "UNITS", "of the largest [unit]");
    add(c, "--least", p.least, "SHARE", "the smallest, as a share of that");
    add(c, "--flat", p.flat, "SHARE", "a fleck's half axes differ down to that share; 1: balls");
    add(c, "--segments", p.segments, "N", "around a fleck; even");
    return {c,
            [o](std::uint32_t seed) {
                o->params.seed = seed;
                o->params.check();
                const TriangleMesh body = mesh::readMesh(o->within);
                const mesh::MeshReport report = mesh::checkTopology(body);
                if (!report.boundsVolume())
                    throw DataError(mesh::meshTitle(o->within) +
                                    ": found a mesh that bounds no volume, expected a closed one "
                                    "that looks outward");
                return shapes::makeFlecks(o->params, body);
            },
            [o] { return std::vector{o->within}; }, [] { return false; }};
}

} // namespace

std::vector<Kind> addKinds(CLI::App& app) {
    app.require_subcommand(1);
    return {addRevolve(app), addImplicit(app), addBrilliant(app), addPrism(app), addBox(app),
            addSphere(app),  addLogo(app),     addWave(app),      addFlecks(app)};
}

} // namespace eikonal::meshgen
