// Sharp boundaries on the page: bars, tables, the plot's data.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "page.h"
#include "report.h"

#include <algorithm>

namespace accuracy {

namespace {

/// Of blurred ways so near the least error the cheapest is the best.
constexpr double kNoWorse = 1.05;

double half(const Json& way) {
    return way["half"].get<double>();
}

double time(const Json& way) {
    return way["ms"].get<double>();
}

/// The ways of one size that have a line in the table.
struct Chosen {
    Json sources, cheapest, best; ///< blurred: the best is the cheapest of the most accurate
    Json through, all;            ///< sharp: refraction alone, all branches
    Json mesh;                    ///< refraction alone, by a mesh's distances; maybe null
};

Chosen chosenOf(const Json& row) {
    Chosen chosen;
    const Json& ways = row["ways"];
    double least = 1e300;
    for (const Json& way : ways)
        if (way["edge"] == "blurred") least = std::min(least, half(way));
    for (const Json& way : ways) {
        if (way["edge"] == "sharp") (way["name"] == "depth 2" ? chosen.through : chosen.all) = way;
        if (way["edge"] == "mesh") chosen.mesh = way;
        if (way["edge"] != "blurred") continue;
        if (chosen.sources.is_null()) chosen.sources = way;
        if (chosen.cheapest.is_null() || time(way) < time(chosen.cheapest)) chosen.cheapest = way;
        if (half(way) <= kNoWorse * least &&
            (chosen.best.is_null() || time(way) < time(chosen.best)))
            chosen.best = way;
    }
    return chosen;
}

std::string nameOf(const Json& way) {
    return print("σ %g, ", way["sigma"].get<double>()) + way["name"].get<std::string>();
}

const Json* glassRow(const std::vector<Json>& rows, const std::string& what) {
    for (const Json& row : rows)
        if (row["part"] == "glass" && row["what"] == what) return &row;
    return nullptr;
}

void judgeBall(Summary& summary, const Json& row) {
    const Chosen ways = chosenOf(row);
    addBar(summary, "128³: sharp ≤ 1/100 of the best blurred error at mid impact",
           share(half(ways.through) / half(ways.best)) +
               print(": %.2g° against %.2g° of ", half(ways.through), half(ways.best)) +
               nameOf(ways.best),
           half(ways.through) <= 0.01 * half(ways.best));
    const auto faster = [&](const std::string& what, const Json& way) {
        const double ratio = way["to_sources"];
        addBar(summary, "128³ homogeneous ball: " + what + " faster than the blurred march",
               print("%.2f of the time of the sources' scheme, %.2f of the cheapest blurred one's",
                     ratio, time(way) / time(ways.cheapest)),
               ratio < 1);
    };
    faster("sharp, refraction alone,", ways.through);
    faster("sharp, all branches to depth 8,", ways.all);
}

void judgeDirections(Summary& summary, const std::vector<Json>& rows) {
    const std::pair<const char*, const char*> kinds[] = {{"glass", "a ball of glass"},
                                                         {"bubble", "a bubble in glass"},
                                                         {"diamond", "a ball of diamond"}};
    for (const auto& [kind, words] : kinds) {
        const Json* row = glassRow(rows, kind);
        if (!row) continue;
        const double near = (*row)["to_95"], far = (*row)["to_99"];
        addBar(summary,
               "64³, sharp, " + std::string(words) +
                   ": within 0.01° to 0.95 of the radius, 0.1° to 0.99",
               print("the worst ray %.2g° off, then %.2g°", near, far), near < 0.01 && far < 0.1);
    }
    if (const Json* row = glassRow(rows, "graded")) {
        const double worst = (*row)["to_95"];
        addBar(summary, "64³, sharp, a Luneburg lens of rim index 1.5: within 0.02° to 0.95",
               print("the worst ray %.2g° off", worst), worst < 0.02);
    }
}

void judgePower(Summary& summary, const std::vector<Json>& rows) {
    if (const Json* row = glassRow(rows, "orders")) {
        const double off = (*row)["off"], rays = (*row)["rays"];
        addBar(summary, "64³, sharp: Fresnel's weights of a ball's first four orders to 1e-3",
               print("off by %.2g at most, %.0f rays", off, rays), off <= 1e-3);
    }
    if (const Json* row = glassRow(rows, "wine")) {
        const double off = (*row)["off"], rays = (*row)["rays"];
        addBar(summary, "64³, sharp, wine in a ball of glass, a bubble in the wine: energy to 1e-4",
               print("off by %.2g at most, %.0f rays", off, rays), off <= 1e-4);
    }
    for (const Json& row : partOf(rows, "sharp light")) {
        const double error = row["error"];
        addBar(summary, "sharp, fluence under a ball: ≤ 3 % at 128³ with 2^24 photons",
               print("%.2g %%", 100 * error) + print(" at %.0f³ with 2^%.0f photons",
                                                     row["voxels"].get<double>(),
                                                     row["power"].get<double>()),
               error <= 0.03);
    }
}

void writeLine(std::ostringstream& out, const Json& row, const std::string& what, const Json& way,
               const Json& cheapest) {
    line(out, {number(row["voxels"]), what, number(way["half"]), number(way["rim"]),
               number(way["ms"]), number(way["to_sources"]), number(time(way) / time(cheapest))});
}

} // namespace

void judgeSharp(Summary& summary, const std::vector<Json>& rows) {
    for (const Json& row : partOf(rows, "sharp"))
        if (row["voxels"] == 128) judgeBall(summary, row);
    judgeDirections(summary, rows);
    judgePower(summary, rows);
}

std::string sharpSection(const std::vector<Json>& rows) {
    std::ostringstream out;
    out << "## Sharp boundaries\n\n"
        << "A homogeneous ball of index 1.5, its radius 0.41 of the box, its centre off the "
           "lattice, seen by parallel rays that it nearly fills the picture of. Errors are "
           "of the direction behind the ball against Snell's law [degree], rms over all "
           "azimuths, at impacts of 0.45 to 0.55 of the radius and of 0.94 to 0.96; times "
           "are of the view pass, medians of rounds in which all ways take turns. The "
           "sources blur what `--supersample 4` counts by σ 1.5; the best blur is that of "
           "what `--supersample 8` counts whose rays, traced well, are off by the least at "
           "half the radius, drawn by the cheapest tracing that comes within 5 % of the "
           "least error of any. The cheapest blurred way is listed for its time. Sharp: "
           "distances of the formula, or where it says so of a mesh of 327,680 facets, curved "
           "as `mesh2vol` does.\n\n";
    head(out, {"voxels", "edge, tracing", "error at half", "at the rim", "time [ms]", "to sources'",
               "to cheapest blurred"});
    for (const Json& row : partOf(rows, "sharp")) {
        const Chosen ways = chosenOf(row);
        const auto add = [&](const std::string& what, const Json& way) {
            writeLine(out, row, what, way, ways.cheapest);
        };
        add("blurred as the sources do: " + nameOf(ways.sources), ways.sources);
        add("blurred, cheapest: " + nameOf(ways.cheapest), ways.cheapest);
        add("blurred, best: " + nameOf(ways.best), ways.best);
        add("sharp, refraction alone", ways.through);
        add("sharp, all branches to depth 8", ways.all);
        if (!ways.mesh.is_null()) add("sharp, refraction alone, a mesh's distances", ways.mesh);
    }
    out << "\nFrom 128³ on hardly more than roundings are seen, of the formula and of the mesh.\n"
        << "\n![Error against time of a ball of glass](accuracy/sharp.svg)\n\n"
        << "Traced well (verlet, cubic, steps of half a voxel), a blurred edge by its width, at "
           "half "
           "the radius and at the rim [degree]:\n\n";
    head(out, {"voxels", "σ [voxel]", "error at half", "at the rim"});
    for (const Json& row : partOf(rows, "sharp"))
        for (const Json& tried : row["sigmas"])
            line(out, {number(row["voxels"]), number(tried["sigma"]), number(tried["half"]),
                       number(tried["rim"])});
    out << '\n';
    return out.str();
}

std::string sharpCsv(const std::vector<Json>& rows) {
    std::ostringstream out;
    bool first = true;
    for (const char* edge : {"blurred", "sharp"})
        for (const Json& row : partOf(rows, "sharp")) {
            out << (first ? "" : "\n\n")
                << Json(edge + (" " + std::to_string(row["voxels"].get<int>())) + "³") << '\n';
            first = false;
            for (const Json& way : row["ways"])
                if (way["edge"] == edge)
                    out << way["ms"] << ',' << way["half"] << ',' << way["rim"] << ','
                        << way["name"] << '\n';
        }
    return out.str();
}

} // namespace accuracy
