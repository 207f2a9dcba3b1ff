// docs/accuracy.md, from the rows.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.h"

#include "image_space.h"
#include "page.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <sstream>
#include <thread>

namespace accuracy {

namespace {

/// A label of photons without their number, which stands last.
std::string withoutNumber(const std::string& label) {
    return label.substr(0, label.rfind(", "));
}

void writeHead(std::ostringstream& out, const Bench& bench) {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    char day[32];
    std::strftime(day, sizeof day, "%Y-%m-%d", &parts);
    out << "# What accuracy costs\n\n"
        << "Written by `make accuracy" << (bench.full ? "" : " ACCURACY=quick") << "` on " << day
        << "; " << bench.device.info().renderer << ", " << std::thread::hardware_concurrency()
        << " processors. Errors repeat, times do not: trust their ratios, medians of three pairs "
           "with the sources' scheme.\n\n"
        << "Errors of view rays are root mean squares of exit positions over 64×64 parallel rays, "
           "against rays traced in double through the formula that the voxels were sampled from. "
           "The unit is a voxel of 128³; voxels are 128³ where nothing else is said. Means are "
           "geometric, over six smooth fields: n² linear across the diagonal, a GRIN rod of three "
           "pitches, the core of a Luneburg lens, Maxwell's fish-eye, layers that turn rays back, "
           "a ball with an edge of σ 2.5 voxels. The sources' scheme is that of the older papers: "
           "Euler steps of one voxel on plain central differences, linearly interpolated.\n\n";
}

void writeBars(std::ostringstream& out, const Summary& summary) {
    out << "## Bars\n\n";
    head(out, {"bar", "found", "met"});
    for (const Json& bar : summary.bars)
        line(out, {bar["bar"], bar["found"], bar["met"].get<bool>() ? "yes" : "**no**"});
    out << '\n';
}

void writeFrontier(std::ostringstream& out, const Summary& summary) {
    out << "## View rays: the frontier\n\n"
        << "Settings that no other beats in both error and time, cheapest first. \"Buys\" is the "
           "factor off the error of the row above, and what it costs more for this picture.\n\n";
    head(out, {"setting", "error [voxel]", "error to sources'", "time to sources'", "time [ms]",
               "buys"});
    const Json* last = nullptr;
    for (const Json& s : summary.frontier) {
        std::string buys;
        if (last)
            buys = "1/" + number((*last)["error"].get<double>() / s["error"].get<double>()) +
                   " for " + number(s["ms"].get<double>() - (*last)["ms"].get<double>()) + " ms";
        line(out, {s["label"], number(s["error"]), share(s["error_ratio"]), number(s["time_ratio"]),
                   number(s["ms"]), buys});
        last = &s;
    }
    out << "\n![Error against time](accuracy/rays.svg)\n\n";
}

void writeAdvice(std::ostringstream& out, const std::vector<Json>& rows, const Summary& summary) {
    out << "## Three price points\n\n";
    head(out, {"", "`render`", "error to sources'", "time to sources'"});
    const char* names[] = {"default", "finer", "finest"};
    const std::string labels[] = {usual().name(), summary.second, summary.third};
    for (int i = 0; i < 3; ++i)
        for (const Json& s : summary.settings)
            if (s["label"] == labels[i])
                line(out, {names[i],
                           i == 0 ? "`render`" : "`render " + s["options"].get<std::string>() + "`",
                           share(s["error_ratio"]), number(s["time_ratio"])});
    out << "\nOf photons' steps alone, against the same photons traced through a spline in steps "
           "of a quarter voxel; 'finer' costs at most two and a half times the default. More "
           "photons are the other half of it: see below.\n\n";
    head(out, {"", "`lightsim`", "error of the steps", "time [ms]"});
    const Json *plain = nullptr, *finer = nullptr, *finest = nullptr;
    const std::vector<Json> light = partOf(rows, "light");
    const auto error = [](const Json& row) { return row["step_error"].get<double>(); };
    for (const Json& row : light) {
        const std::string label = row["label"];
        if (label.starts_with("default")) plain = &row;
        if (!plain || row["plain"].get<bool>() || row["smoothing"] != 0) continue;
        const bool cheap = row["ms"].get<double>() <= 2.5 * (*plain)["ms"].get<double>();
        if (cheap && (!finer || error(row) < error(*finer))) finer = &row;
        if (!finest || error(row) < error(*finest)) finest = &row;
    }
    int i = 0;
    for (const Json* row : {plain, finer, finest}) {
        if (!row) continue;
        const std::string options = withoutNumber((*row)["label"]);
        line(out, {names[i++], options == "default" ? "`lightsim`" : "`lightsim " + options + "`",
                   number(error(*row)), number((*row)["ms"])});
    }
    out << '\n';
}

void writeSettings(std::ostringstream& out, const std::vector<Json>& rows, const Summary& summary) {
    out << "## Integrator, interpolation, step, tolerance\n\n";
    head(out, {"setting", "error [voxel]", "error to sources'", "time to sources'"});
    for (const Json& s : summary.settings)
        line(out,
             {s["label"], number(s["error"]), share(s["error_ratio"]), number(s["time_ratio"])});
    out << "\nBy field, in voxels; the fields in italics have an edge or a kink and are in no "
           "mean:\n\n";
    Cells names{"field"};
    std::vector<std::string> shown{sources().name(), usual().name()};
    for (const std::string& more :
         {fixed("verlet", "cubic", 1).name(), summary.second, summary.third})
        if (std::find(shown.begin(), shown.end(), more) == shown.end()) shown.push_back(more);
    names.insert(names.end(), shown.begin(), shown.end());
    head(out, names);
    for (const Field& field : fields()) {
        Cells cells{field.smooth ? field.name : "*" + field.name + "*"};
        for (const std::string& label : shown) {
            std::string cell = "–";
            for (const Json& row : partOf(rows, "rays"))
                if (row["label"] == label + " on " + field.name) cell = number(row["rms"]);
            cells.push_back(cell);
        }
        line(out, cells);
    }
    out << "\nA tolerance against the worst of 64×64 exits, from those of short steps in the same "
           "voxels; \"reckoned\" is what the tracer itself notes as the worst. Below some 1e-3 "
           "voxel it is "
           "roundings that differ, those of the short steps too:\n\n";
    head(out, {"field", "asked", "reached", "reckoned", "steps a ray"});
    for (const Json& row : partOf(rows, "tolerance"))
        for (size_t i = 0; i < row["asked"].size(); ++i)
            line(out, {i == 0 ? row["field"].get<std::string>() : "", number(row["asked"][i]),
                       number(row["worst"][i]), number(row["noted"][i]), number(row["steps"][i])});
    out << '\n';
}

void writeOrders(std::ostringstream& out, const Summary& summary) {
    out << "## Orders, and rays that go round\n\n"
        << "The slope over the finest octave whose errors are well above those of floats (3e-4 "
           "voxel, and three times the least of the row), median over the fields that have one. "
           "In the step against short steps in the same "
           "voxels, in the voxel against the formula.\n\n";
    head(out, {"of", "order", "least", "most", "fields"});
    for (const Json& order : summary.orders)
        line(out, {order["of"], number(order["order"]), number(order["least"]),
                   number(order["most"]), number(order["fields"])});
    out << "\n![Error against the step](accuracy/steps.svg)\n\n"
        << "![Error against voxels](accuracy/voxels.svg)\n\n"
        << "Ten turns: the largest deviation [voxel] of a rod's amplitude, of a circle's radius "
           "and place, and | |w| − n |. Euler's rays are lost on the way.\n\n";
    head(out, {"orbit", "turns 1 to 5", "turns 6 to 10", "drift of n"});
    for (const Json& orbit : summary.orbits)
        line(out,
             {orbit["of"], number(orbit["early"]), number(orbit["late"]), number(orbit["drift"])});
    out << '\n';
}

void writeChain(std::ostringstream& out, const std::vector<Json>& rows) {
    out << "## From mesh to smooth voxels\n\n"
        << "A ball of index 1.5 and a radius of a quarter of the box, through `mesh2vol` and "
           "`volsmooth`; angle between rays behind it and Snell's law [degree], rms, at impacts of "
           "half the radius and of nine tenths. \"Traced well\" is Sharma's scheme in steps of a "
           "quarter voxel: what is left is of the blurred edge.\n\n";
    head(out, {"voxels", "`--supersample`", "`--sigma`", "volume off by", "half: traced well",
               "default", "sources'", "rim: traced well", "default", "sources'"});
    for (const Json& row : partOf(rows, "chain"))
        line(out, {number(row["voxels"]), number(row["supersample"]), number(row["sigma"]),
                   number(row["volume_error"]), number(row["exact_half"]),
                   number(row["usual_half"]), number(row["sources_half"]), number(row["exact_rim"]),
                   number(row["usual_rim"]), number(row["sources_rim"])});
    out << '\n';
}

void writeLight(std::ostringstream& out, const std::vector<Json>& rows) {
    out << "## Photons\n\n"
        << "A blurred ball in haze, 64³, a slanting light; relative rms of the fluence over all "
           "voxels, which the few bright ones of the focus outweigh. \"Steps\": from the same "
           "photons traced through a spline in steps of a quarter voxel. \"All\": from so traced "
           "photons of another seed, as many as the last row of the table below. Nothing is "
           "smoothed "
           "here but where it says so; `lightsim` itself smooths once.\n\n";
    head(out, {"options", "million steps", "time [ms]", "steps", "all"});
    for (const Json& row : partOf(rows, "light"))
        line(out,
             {"`" + withoutNumber(row["label"]) + "`", number(row["steps"].get<double>() / 1e6),
              number(row["ms"]), number(row["step_error"]), number(row["error"])});
    out << "\nSmoothing trades noise for sharpness: here it blurs the focus.\n\n";
    head(out, {"options", "photons", "time [ms]", "all", "noise alone"});
    for (const Json& row : partOf(rows, "photons"))
        line(out, {withoutNumber(row["label"]), std::to_string(row["photons"].get<std::int64_t>()),
                   number(row["ms"]), number(row["error"]), number(row["noise"])});
    out << "\n![Error of the fluence against time](accuracy/photons.svg)\n\n"
        << "Against paper: a slab under Beer and Lambert's law, and a point light outside its "
           "box. Slabs are exact but for floats, since photons stand in even rows.\n\n";
    head(out, {"photons", "slab", "point light"});
    for (const Json& row : partOf(rows, "slab"))
        for (const Json& point : partOf(rows, "point"))
            if (point["photons"] == row["photons"])
                line(out, {std::to_string(row["photons"].get<std::int64_t>()), number(row["error"]),
                           number(point["error"])});
    out << "\nThe caustic of a ball, not smoothed, against photons "
           "by Snell's law in double: it is the blurred edge, not the photons or their steps, "
           "that the error comes from, and it falls with the edge's width in units.\n\n";
    head(out, {"voxels", "σ [voxel]", "photons' steps", "all voxels", "behind the ball"});
    for (const Json& row : partOf(rows, "caustic"))
        line(out,
             {number(row["voxels"]), number(row["sigma"]),
              row["integrator"].get<std::string>() + " " + row["interpolation"].get<std::string>(),
              number(row["error"]), number(row["behind"])});
    out << '\n';
}

void writeLimits(std::ostringstream& out) {
    out << "## Known limits\n\n"
        << "- Positions and kicks are floats that every step adds to. On splines, what is rounded "
           "off "
           "one step is kept for the next; on linear samples, where it would cost a tenth of the "
           "time, roundings add up, and where steps are exact, in n² that is linear, shorter "
           "ones make the error larger.\n"
        << "- Linear samples are the gradient of no potential: | |w| − n | stays small, but rays "
           "that "
           "go round for many turns drift off their circle, by the lattice. Splines keep them.\n"
        << "- Devices whose filters blend with few bits (graphics cards mostly have 8 for a voxel) "
           "add their own error to linear look-ups; cubic ones use no filter.\n"
        << "- A spline rings for some voxels round a kink in the index: in the clipped rod, whose "
           "rays stay three voxels away from the kink, linear samples are better.\n"
        << "- At an edge of 1.5 voxels the blur itself is off by more than any of the integrators: "
           "finer steps find the exits of the blurred ball, not those of the ball. Sharp "
           "boundaries have no edge.\n"
        << "- The means are of fields that suit a spline. A field of your own is judged by `--aov "
           "error`, and by halving the step.\n";
}

} // namespace

std::string pageOf(const std::vector<Json>& rows, const Summary& summary, const Bench& bench) {
    std::ostringstream out;
    writeHead(out, bench);
    writeBars(out, summary);
    writeFrontier(out, summary);
    writeAdvice(out, rows, summary);
    writeSettings(out, rows, summary);
    writeOrders(out, summary);
    writeChain(out, rows);
    out << sharpSection(rows) << imageSection(rows);
    writeLight(out, rows);
    writeLimits(out);
    return out.str();
}

} // namespace accuracy
