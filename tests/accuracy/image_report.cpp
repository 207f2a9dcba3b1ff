// Refraction in image space on the page: its bars and its table.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image_space.h"
#include "page.h"

namespace accuracy {

namespace {

const Json* find(const std::vector<Json>& rows, const std::string& body, const std::string& way) {
    for (const Json& row : rows)
        if (row["body"] == body && row["way"] == way) return &row;
    return nullptr;
}

/// The bodies, in the order of their first rows.
std::vector<std::string> bodiesOf(const std::vector<Json>& rows) {
    std::vector<std::string> bodies;
    for (const Json& row : rows) {
        const std::string body = row["body"];
        if (bodies.empty() || bodies.back() != body) bodies.push_back(body);
    }
    return bodies;
}

std::string percent(const Json& share) {
    return share.is_null() ? "–" : print("%.0f %%", 100 * share.get<double>());
}

std::string degrees(const Json& angle) {
    if (angle.is_null()) return "–";
    const double degrees = angle;
    return print(degrees < 10 ? "%.2g°" : "%.0f°", degrees);
}

/// That one way is nearer to the truth than another in the mean, on every body that counts.
void judge(Summary& summary, const std::vector<Json>& rows, const std::string& bar,
           const std::string& better, const std::string& worse, const std::string& of,
           bool (*counts)(const Json&)) {
    std::string found;
    bool met = true, any = false;
    for (const std::string& body : bodiesOf(rows)) {
        const Json *a = find(rows, body, better), *b = find(rows, body, worse);
        if (!a || !b || !counts(*a)) continue;
        any = true;
        const double first = (*a)[of], second = (*b)[of];
        met = met && first < second;
        found += (found.empty() ? "" : ", ") + body + print(": %.2g° against %.2g°", first, second);
    }
    if (any) addBar(summary, bar, found, met);
}

} // namespace

void judgeImages(Summary& summary, const std::vector<Json>& all) {
    const std::vector<Json> rows = partOf(all, "image space");
    judge(summary, rows, "image space, concave bodies: dir nearer to exact rays than isr", "dir",
          "isr", "mean", [](const Json& row) { return row["kind"] == "concave"; });
    judge(summary, rows,
          "image space, beyond two refractions: 4 layers nearer to exact rays than dir alone",
          "dir, 4 layers", "dir", "mean_more",
          [](const Json& row) { return row["more"].get<double>() > 0.01; });
}

std::string imageSection(const std::vector<Json>& all) {
    const std::vector<Json> rows = partOf(all, "image space");
    if (rows.empty()) return "";
    const int size = rows.front()["full"].get<bool>() ? 512 : 256;
    std::ostringstream out;
    out << "## Image space\n\n"
        << "Bodies of index 1.5, each nearly as high as a picture of " << size
        << "², by the methods of "
        << "[image-space.md](image-space.md), against `--method rays`: over the pixels that a body "
           "covers, the share whose exit direction is within 1° of the exact one, and the mean "
           "angle "
           "between the two; the same where exact rays are refracted twice and no more, and where "
           "they meet further interfaces or are reflected totally, whose share of the pixels "
           "stands "
           "first. Times are of a frame, its download included, medians of five; those of rays are "
           "of all orders.\n\n";
    head(out, {"body", "method", "within 1°", "mean", "refracted twice: within 1°", "mean",
               "others: share", "within 1°", "mean", "time [ms]"});
    for (const std::string& body : bodiesOf(rows)) {
        double exact = 0;
        for (const Json& row : rows) {
            if (row["body"] != body) continue;
            exact = row["rays_ms"];
            line(out, {row["kind"].get<std::string>() + ": " + body, row["way"],
                       percent(row["close"]), degrees(row["mean"]), percent(row["close_twice"]),
                       degrees(row["mean_twice"]), percent(row["more"]), percent(row["close_more"]),
                       degrees(row["mean_more"]), number(row["ms"])});
        }
        line(out, {body, "rays", "100 %", "0°", "", "", "", "", "", number(exact)});
    }
    out << "\nWhere rays are refracted twice, dir follows the back faces that isr guesses at. What "
           "is "
           "reflected totally neither follows: layers do, until a ray asks for faces that no pixel "
           "has seen. On a processor layers cost more than exact rays; they are for devices that "
           "draw.\n\n";
    return out.str();
}

} // namespace accuracy
