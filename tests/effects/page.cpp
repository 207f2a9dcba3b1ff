// The page that says what effects cost, from the results.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "effects.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

namespace effects {

namespace {

// What an absent effect may cost, as a share of the pass.
constexpr double kGoal = 0.03;

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

std::string priceTable(const Json& rows, const std::string& head, bool tracing) {
    std::string page =
        "| " + head +
        " | time | middle half | steps | memory [MB] | instructions | program [kB] | "
        "switches |\n|---|---|---|---|---|---|---|---|\n";
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
                switchesText(row["switches"], base["switches"]) + " |\n";
    }
    return page + "\n";
}

std::string absenceTable(const Json& part) {
    std::string page =
        "`shaders/" + part["kernel"].get<std::string>() + "`, " + part["scene"].get<std::string>() +
        ":\n\n| without | time | middle half | fastest | instructions, full | without | "
        "program, full [kB] | without |\n|---|---|---|---|---|---|---|---|\n";
    for (const Json& row : part["rows"])
        page += "| " + row["without"].get<std::string>() + " | " + ratioText(row["ratio"], 3) +
                text(" | %.3f | ", row["ratio"]["fastest"].get<double>()) +
                countText(row["instructions_full"]) + " | " +
                countText(row["instructions_without"]) +
                (row["same_instructions"].get<bool>() ? ", the same | " : " | ") +
                kilobytes(row["program_bytes_full"]) + " | " +
                kilobytes(row["program_bytes_without"]) + " |\n";
    return page + "\n";
}

/// Names, one after the other.
struct List {
    std::string names;
    void add(const std::string& name) { names += (names.empty() ? "" : "; ") + name; }
};

/// What the tables of absence come to, in a few sentences.
std::string verdict(const Json& parts) {
    double noise = 0;
    List over, overBySame, more;
    int rows = 0, same = 0;
    for (const Json& part : parts)
        for (size_t i = 0; i < part["rows"].size(); ++i) {
            const Json& row = part["rows"][i];
            const Json& ratio = row["ratio"];
            const double cost = ratio["median"].get<double>() - 1;
            if (i == 0) {
                noise = std::max(
                    {noise, ratio["high"].get<double>() - 1, 1 - ratio["low"].get<double>()});
                continue;
            }
            const bool isSame = row["same_instructions"].get<bool>();
            const std::string name =
                row["without"].get<std::string>() + " (" + part["kernel"].get<std::string>() + ", ";
            ++rows;
            same += isSame ? 1 : 0;
            if (cost > kGoal)
                (isSame ? overBySame : over).add(name + text("%+.1f %%)", 100 * cost));
            if (row["instructions_full"].is_null()) continue;
            const int stay =
                row["instructions_full"].get<int>() - row["instructions_without"].get<int>();
            if (stay != 0) more.add(name + text("%+d)", stay));
        }
    std::string said =
        text("Of %d cuts %d leave the very same instructions in the same order: what "
             "times differ by there is noise, as between the full text and itself (up "
             "to %.1f %% within the middle half of the rounds). ",
             rows, same, 100 * noise);
    if (!more.names.empty())
        said += "The full text has more instructions, outside its loops, than the texts without: " +
                more.names + ". ";
    if (over.names.empty() && same == rows) return said + "\n\n";
    said += over.names.empty() ? text("None of the others costs more than %.0f %%. ", 100 * kGoal)
                               : text("Above %.0f %% are: ", 100 * kGoal) + over.names + ". ";
    if (!overBySame.names.empty())
        said += text("Above %.0f %% by noise alone: ", 100 * kGoal) + overBySame.names + ". ";
    said.back() = '\n';
    return said + "\n";
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
        r["price_rounds"].get<int>());
    page +=
        "*Steps* are to the first row's. *Memory* is the largest amount on the device at a time, "
        "after the first row what is added to it. *Instructions* are those of the kernel as "
        "optimised SPIR-V (glslang, `spirv-opt -O`), on which no device has a say; *program* is "
        "the linked program's size as the driver tells. *Switches* are those that differ from "
        "the first row's, as the driver was given them.\n\n";
    page += "## What is there\n\nLooking, by pixel:\n\n";
    page += priceTable(r["view"], "to refraction is added", false);
    page += priceTable(r["view"], "rays are traced by", true);
    page +=
        "Looking at a ball of the same size within a sharp boundary, by pixel. What is in it is in "
        "it alone; where its index varies it is a Luneburg lens of glass.\n\n";
    page += priceTable(r["sharp"], "to refraction is added", false);
    page += priceTable(r["sharp"], "rays between boundaries are traced by", true);
    page +=
        "Lighting, by photon. Media are thin, and dense or opaque only in a corner, so that all "
        "photons go all the way: what is priced is the kernel. Scattering dims and stores as "
        "absorption does. Resolving and smoothing what was stored is not counted.\n\n";
    page += priceTable(r["photon"], "to refraction is added", false);
    page += priceTable(r["photon"], "photons are traced by", true);
    page +=
        text("## What is not there\n\nA scene without an effect should cost what it would if the "
             "effect had never been written: no more than %.0f %% beside it. Here the code of "
             "each is cut out of the kernel's text: the branches it needs, what only they call "
             "and read, and its members of structs; identifiers that are left, or passages that "
             "are no longer found, are errors ([cuts.cpp](../tests/effects/cuts.cpp), "
             "[sharp_cuts.cpp](../tests/effects/sharp_cuts.cpp)). *Time* is the"
             " full text's to that of the text without, the median over %d rounds in turns; "
             "*fastest* is the ratio of both texts' fastest runs, to which whatever else the "
             "machine does adds least. "
             "`test_effects` holds pixels and fluence to the same bits, and the instructions.\n\n",
             100 * kGoal, r["rounds"].get<int>());
    page += verdict(r["absent"]);
    for (const Json& part : r["absent"]) page += absenceTable(part);
    page +=
        "In memory an absent effect takes nothing: a file whose grids are all 0 gets the same "
        "switches and the same bytes as one without them (`test_effects`). Sharp boundaries have a "
        "kernel of their own: of them blurred ones have nothing to be cut.\n";
    return page;
}

} // namespace effects
