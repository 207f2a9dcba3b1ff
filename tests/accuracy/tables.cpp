// The plots' data.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace accuracy {

namespace {

std::string settingsCsv(const Json& settings) {
    std::ostringstream out;
    out << "label,time_ratio,error_ratio,ms,error\n";
    for (const Json& s : settings)
        out << s["label"] << ',' << s["time_ratio"] << ',' << s["error_ratio"] << ',' << s["ms"]
            << ',' << s["error"] << '\n';
    return out.str();
}

/// A block of lines per name, two blank lines between blocks.
std::string photonsCsv(const std::vector<Json>& rows) {
    std::ostringstream out;
    std::string last;
    for (const Json& row : partOf(rows, "photons")) {
        const std::string label = row["label"], name = label.substr(0, label.rfind(", "));
        if (name != last) out << (last.empty() ? "" : "\n\n") << Json(name) << '\n';
        last = name;
        out << row["photons"] << ',' << row["ms"] << ',' << row["error"] << ',' << row["noise"]
            << '\n';
    }
    return out.str();
}

/// Geometric means over the smooth fields: one line per x, one column per name, none where a field
/// lacks a number.
class Columns {
public:
    void add(const std::string& name, double x, double error) {
        if (std::find(mNames.begin(), mNames.end(), name) == mNames.end()) mNames.push_back(name);
        auto& [logs, count] = mSums[{x, name}];
        logs += std::log(std::max(error, 1e-9));
        ++count;
        mXs.insert(x);
    }
    std::string csv(const std::string& x) const {
        std::ostringstream out;
        out << x;
        for (const std::string& name : mNames) out << ',' << Json(name);
        out << '\n';
        for (const double at : mXs) {
            out << at;
            for (const std::string& name : mNames) {
                out << ',';
                const auto sum = mSums.find({at, name});
                if (sum != mSums.end()) out << std::exp(sum->second.first / sum->second.second);
            }
            out << '\n';
        }
        return out.str();
    }

private:
    std::vector<std::string> mNames;
    std::map<std::pair<double, std::string>, std::pair<double, int>> mSums;
    std::set<double> mXs;
};

std::string voxelsCsv(const std::vector<Json>& rows) {
    Columns columns;
    for (const Json& row : partOf(rows, "voxels")) {
        if (!fieldNamed(row["field"]).smooth) continue;
        const std::string label = row["label"];
        columns.add(label.substr(0, label.find(" on ")), row["voxels"], row["rms"]);
    }
    return columns.csv("voxels");
}

std::string stepsCsv(const std::vector<Json>& rows) {
    Columns columns;
    for (const Json& row : partOf(rows, "order")) {
        const std::string name = row["integrator"].get<std::string>() +
                                 (row["plain"].get<bool>() ? " plain " : " ") +
                                 row["interpolation"].get<std::string>();
        for (size_t i = 0; i < row["steps"].size(); ++i)
            columns.add(name, row["steps"][i], row["errors"][i]);
    }
    return columns.csv("step");
}

} // namespace

std::map<std::string, std::string> plotData(const std::vector<Json>& rows, const Summary& summary) {
    return {{"rays.csv", settingsCsv(summary.settings)},
            {"front.csv", settingsCsv(summary.frontier)},
            {"photons.csv", photonsCsv(rows)},
            {"sharp.csv", sharpCsv(rows)},
            {"voxels.csv", voxelsCsv(rows)},
            {"steps.csv", stepsCsv(rows)}};
}

} // namespace accuracy
