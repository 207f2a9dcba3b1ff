// The page that says what effects cost, from the results.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <map>
#include <utility>

namespace effects {

namespace {

[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...) {
    va_list values, again;
    va_start(values, format);
    va_copy(again, values);
    std::string result(static_cast<size_t>(std::vsnprintf(nullptr, 0, format, values)), '\0');
    std::vsnprintf(result.data(), result.size() + 1, format, again);
    va_end(again);
    va_end(values);
    return result;
}

std::string ratioText(const Json& ratio, int digits) {
    return text("%.*f | %.*f to %.*f", digits, ratio["median"].get<double>(), digits,
                ratio["low"].get<double>(), digits, ratio["high"].get<double>());
}

std::string countText(const Json& count) {
    return count.is_null() ? "–" : text("%d", count.get<int>());
}

std::string kilobytes(const Json& bytes) {
    const auto value = bytes.get<std::int64_t>();
    return value == 0 ? "–" : text("%.1f", static_cast<double>(value) / 1e3);
}

/// What of the switches differs from those of the first row.
std::string switchesText(const Json& switches, const Json& base) {
    std::string changed;
    for (const auto& [name, value] : switches.items())
        if (value != base[name])
            changed += (changed.empty() ? "" : " ") + name + "=" + std::to_string(value.get<int>());
    return changed.empty() ? "–" : changed;
}

std::string nameOf(const Json& binding) {
    return binding["kind"].get<std::string>() + text(" %d", binding["number"].get<int>());
}

std::string listOf(const Json& bindings, const Json& less) {
    std::string names;
    for (const Json& binding : bindings)
        if (std::count(less.begin(), less.end(), binding) == 0)
            names += (names.empty() ? "" : ", ") + nameOf(binding);
    return names;
}

/// What is bound beside that of the first row, and what of that is not.
std::string bindingsText(const Json& bindings, const Json& base) {
    if (bindings.is_null()) return "–";
    const std::string more = listOf(bindings, base), less = listOf(base, bindings);
    if (more.empty() && less.empty()) return "–";
    return more + (less.empty() ? "" : " without " + less);
}

std::string priceTable(const Json& rows, const std::string& head, bool tracing) {
    std::string page =
        "| " + head +
        " | time | middle half | steps | memory [MB] | instructions | program [kB] | "
        "bindings | switches |\n|---|---|---|---|---|---|---|---|---|\n";
    const Json& base = rows[0];
    for (size_t i = 0; i < rows.size(); ++i) {
        const Json& row = rows[i];
        const bool isBase = i == 0, isNoise = i + 1 == rows.size();
        if (row["tracing"].get<bool>() != tracing || (isBase && tracing) || (isNoise && tracing))
            continue;
        const std::string time =
            isBase ? text("%.0f ms | ", row["ms"].get<double>()) : ratioText(row["ratio"], 2);
        const double added = row["added_bytes"].get<double>() / 1e6;
        const std::string memory =
            isBase ? text("%.1f", row["peak_bytes"].get<double>() / 1e6) : text("%+.1f", added);
        page += "| " + row["name"].get<std::string>() + " | " + time +
                text(" | %.2f | ", row["steps"].get<double>() / base["steps"].get<double>()) +
                memory + " | " + countText(row["instructions"]) + " | " +
                kilobytes(row["program_bytes"]) + " | " +
                (isBase ? text("%zu", row["bindings"].size())
                        : bindingsText(row["bindings"], base["bindings"])) +
                " | " + switchesText(row["switches"], base["switches"]) + " |\n";
    }
    return page + "\n";
}

/// Each binding, and the scenes whose kernels read or write it.
std::string bindingTable(const Json& rows) {
    struct Used {
        std::string name, scenes;
        size_t count = 0;
    };
    std::map<std::pair<std::string, int>, Used> all;
    for (size_t i = 0; i + 1 < rows.size(); ++i) // the last is the first again
        for (const Json& binding : rows[i]["bindings"]) {
            Used& used = all[{binding["kind"].get<std::string>(), binding["number"].get<int>()}];
            used.name = binding["name"];
            used.scenes += (used.scenes.empty() ? "" : "; ") + rows[i]["name"].get<std::string>();
            ++used.count;
        }
    std::string page = "| binding | name | scenes that use it |\n|---|---|---|\n";
    for (const auto& [binding, used] : all)
        page += "| " + binding.first + text(" %d | ", binding.second) + used.name + " | " +
                (used.count + 1 == rows.size() ? "all" : used.scenes) + " |\n";
    return page + "\n";
}

} // namespace

std::string pageOf(const Json& r) {
    std::string page = "# What each effect costs\n\n";
    page +=
        "Written by `make effects`, from `out/effects.json`. Measured on " +
        r["device"].get<std::string>() + ", OpenGL " + r["version"].get<std::string>() + ", " +
        text(
            "%d cores, with a blurred ball of index 1.5 in %d³ voxels, %d×%d pixels and %d photons "
            "from one side.\n\n",
            r["cores"].get<int>(), r["voxels"].get<int>(), r["picture"][0].get<int>(),
            r["picture"][1].get<int>(), r["photons"].get<int>());
    page += text(
        "*Time* is that of the pass on the device as a ratio to the first row's in the same round: "
        "the "
        "median of %d rounds in one process, every round with every row once; *middle half* is the "
        "range of half of them, and *the same again* what noise alone makes of it. ",
        r["rounds"].get<int>());
    page +=
        "*Steps* are to the first row's. *Memory* is the largest amount on the device at a time, "
        "after the first row what is added to it. *Instructions* are those of the kernel as "
        "optimised SPIR-V (" +
        r["compiler"].get<std::string>() +
        "), on which no device has a say; *bindings* are what it reads and writes; *program* is "
        "the linked program's size as the driver tells. *Switches* are those that differ from "
        "the first row's, as the driver was given them.\n\n## What is there\n\n";
    const Json& prices = r["prices"];
    const auto add = [&](Family family, const std::string& head, const std::string& rays) {
        const Json& rows = prices[nameOf(family)];
        page += head + "\n\n" + priceTable(rows, "to refraction is added", false);
        page += priceTable(rows, rays + " traced by", true);
    };
    add(Family::view, "Looking, by pixel:", "rays are");
    add(Family::sharpView,
        "Looking at a ball of the same size within a sharp boundary, by pixel. What is in it is in "
        "it alone; where its index varies it is a Luneburg lens of glass.",
        "rays between boundaries are");
    add(Family::photons,
        "Lighting, by photon. Media are thin, and dense or opaque only in a corner, so that all "
        "photons go all the way: what is priced is the kernel. Scattering dims and stores as "
        "absorption does. Resolving and smoothing what was stored is not counted.",
        "photons are");
    add(Family::sharpPhotons,
        "Lighting the ball within a sharp boundary. Photons go where light meets something, but "
        "all over "
        "the map where the medium varies:",
        "photons between boundaries are");
    add(Family::beams,
        "Lighting a floor under that ball by beams: their points, what becomes of cells, and "
        "laying them "
        "down; *steps* are points:",
        "rays of beams between boundaries are");
    page +=
        "## What is not there\n\nA scene without an effect gets a kernel without it: every row "
        "above has switches of its own, and what they exclude the compiler drops. `test_effects` "
        "holds that by three facts. The optimised kernel of a scene reads and writes what its "
        "effects need and nothing of any other effect's, as below. It has as many instructions as "
        "[instructions.txt](../tests/effects/instructions.txt) says, within 1 %, so that an effect "
        "that leaks into the kernels of others is seen (`make instructions` counts anew). And in "
        "memory an absent effect takes nothing: a file whose grids are all 0 gets the same "
        "switches and the same bytes as one without them.\n\n";
    for (const Family family : kFamilies)
        page += "Kernels of " + nameOf(family) + ":\n\n" + bindingTable(prices[nameOf(family)]);
    return page;
}

} // namespace effects
