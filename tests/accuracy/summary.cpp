// Means over the fields, the frontier, observed orders, and the bars.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image_space.h"
#include "page.h"
#include "report.h"

#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace accuracy {

namespace {

/// Errors near the first are of floats, above the second of rays that go quite another way [unit].
constexpr double kFloatError = 3e-4, kAstray = 2;

/// Some thousand steps, each rounding a place of some tens of voxels, leave so much [voxel].
constexpr double kFloatsOfOrbits = 5e-4;

std::string settingOf(const Json& row) {
    const std::string label = row["label"];
    return label.substr(0, label.find(" on "));
}

/// The slope of the error over the finest octave of `x` in which it is not yet of floats.
std::optional<double> finestSlope(const std::vector<double>& x, const std::vector<double>& error) {
    std::optional<double> slope;
    if (error.empty()) return slope; // a run of some rows only
    double finest = 1e300;
    const double floats = std::max(kFloatError, 3 * *std::min_element(error.begin(), error.end()));
    for (size_t i = 0; i < x.size(); ++i)
        for (size_t k = 0; k < x.size(); ++k) {
            const bool octave = std::abs(x[k] / x[i] - 2) < 1e-6;
            if (!octave || x[i] >= finest || error[i] < floats || error[k] > kAstray) continue;
            finest = x[i];
            slope = std::log2(error[k] / error[i]);
        }
    return slope;
}

const Json* named(const Json& settings, const std::string& label) {
    for (const Json& setting : settings)
        if (setting["label"] == label) return &setting;
    return nullptr;
}

/// The options of `render` that a row stands for; none where it has no option for it.
std::string optionsOf(const Json& row) {
    const std::string integrator = row["integrator"], interpolation = row["interpolation"];
    if (row["plain"].get<bool>() && integrator != "euler") return {};
    std::string options;
    if (integrator == "adaptive")
        options = "--tolerance " + eikonal::toText(row["tolerance"].get<double>());
    else
        options = "--integrator " + integrator;
    const bool linearByItself = integrator == "euler" || integrator == "verlet";
    if (linearByItself != (interpolation == "linear"))
        options += " --interpolation " + interpolation;
    const double step = row["step"];
    eikonal::optics::Tracing tracing;
    tracing.integrator = eikonal::optics::parseIntegrator(integrator);
    if (step > 0 && step != tracing.usualStep()) options += " --step " + eikonal::toText(step);
    return options;
}

/// Geometric means over the smooth fields of errors and times against the sources' scheme.
void addSettings(Summary& summary, const std::vector<Json>& rows) {
    struct Sum {
        double error = 0, ratio = 0, time = 0, ms = 0;
        int fields = 0;
    };
    std::vector<std::string> order;
    std::map<std::string, Sum> sums;
    std::map<std::string, double> base;
    std::map<std::string, std::string> options;
    for (const Json& row : partOf(rows, "rays"))
        if (settingOf(row) == sources().name()) base[row["field"]] = row["rms"].get<double>();
    int smooth = 0;
    for (const Field& field : fields()) smooth += field.smooth ? 1 : 0;
    for (const Json& row : partOf(rows, "rays")) {
        if (!fieldNamed(row["field"]).smooth || !base.contains(row["field"])) continue;
        const std::string name = settingOf(row);
        if (!sums.contains(name)) order.push_back(name);
        options[name] = optionsOf(row);
        Sum& sum = sums[name];
        const double error = std::max(row["rms"].get<double>(), 1e-9);
        sum.error += std::log(error);
        sum.ratio += std::log(error / base.at(row["field"]));
        sum.time += std::log(row["time_ratio"].get<double>());
        sum.ms += std::log(row["ms"].get<double>());
        ++sum.fields;
    }
    for (const std::string& name : order) {
        const Sum& sum = sums[name];
        if (sum.fields != smooth) continue;
        const auto mean = [&](double logs) { return std::exp(logs / sum.fields); };
        summary.settings.push_back({{"label", name},
                                    {"options", options[name]},
                                    {"error", mean(sum.error)},
                                    {"error_ratio", mean(sum.ratio)},
                                    {"time_ratio", mean(sum.time)},
                                    {"ms", mean(sum.ms)}});
    }
}

void addFrontier(Summary& summary) {
    std::vector<Json> sorted(summary.settings.begin(), summary.settings.end());
    std::sort(sorted.begin(), sorted.end(), [](const Json& a, const Json& b) {
        return a["time_ratio"].get<double>() < b["time_ratio"].get<double>();
    });
    double best = 1e300;
    for (const Json& setting : sorted) {
        if (setting["error_ratio"].get<double>() >= best) continue;
        best = setting["error_ratio"].get<double>();
        summary.frontier.push_back(setting);
    }
}

/// Whether a setting's error is, in every field, that of floats or no more than twice the least
/// that any setting has there: what voxels can tell.
bool nothingLeft(const std::vector<Json>& rows, const std::string& setting) {
    std::map<std::string, double> least, own;
    for (const Json& row : partOf(rows, "rays")) {
        const double error = row["rms"];
        const std::string field = row["field"];
        if (!fieldNamed(field).smooth) continue;
        least[field] = least.contains(field) ? std::min(least[field], error) : error;
        if (settingOf(row) == setting) own[field] = error;
    }
    for (const auto& [field, error] : own)
        if (error > std::max(kFloatError, 2 * least[field])) return false;
    return true;
}

/// The default; the most accurate at three times the sources' price; the cheapest of which floats
/// and voxels leave no more to gain, or the most accurate.
void judgeSettings(Summary& summary, const std::vector<Json>& rows) {
    const Json* plain = named(summary.settings, usual().name());
    if (!plain || summary.frontier.empty()) return;
    const auto error = [](const Json& s) { return s["error_ratio"].get<double>(); };
    const auto time = [](const Json& s) { return s["time_ratio"].get<double>(); };
    const auto words = [&](const Json& s) {
        return s["label"].get<std::string>() + ": " +
               print("1/%.0f of the error at %.2f of the time", 1 / error(s), time(s));
    };
    addBar(summary, "default: ≤ 1/10 of the sources' error at ≤ 1.2 of their time", words(*plain),
           error(*plain) <= 0.1 && time(*plain) <= 1.2);
    const Json *second = nullptr, *third = nullptr;
    for (const Json& s : summary.frontier) {
        if (s["options"] == "") continue;
        if (!second || time(s) <= 3) second = &s;
        if (!third || !nothingLeft(rows, (*third)["label"])) third = &s;
    }
    summary.second = (*second)["label"];
    summary.third = (*third)["label"];
    addBar(summary, "finer: ≤ 1/300 at ≤ 6", words(*second),
           error(*second) <= 1.0 / 300 && time(*second) <= 6);
    addBar(summary, "finest: limited by floats or voxels alone in every field",
           words(*third) + print("; %.2g voxels", (*third)["error"].get<double>()),
           nothingLeft(rows, summary.third));
}

struct Slopes {
    std::string of;
    double bar; ///< the least order; 0: none is asked for
    std::vector<double> found;
};

void addOrders(Summary& summary, const std::vector<Slopes>& all) {
    for (Slopes slopes : all) {
        if (slopes.found.empty()) continue;
        const double middle = median(slopes.found);
        const auto [least, most] = std::minmax_element(slopes.found.begin(), slopes.found.end());
        summary.orders.push_back({{"of", slopes.of},
                                  {"order", middle},
                                  {"least", *least},
                                  {"most", *most},
                                  {"fields", slopes.found.size()}});
        if (slopes.bar > 0)
            addBar(summary, slopes.of + print(": order ≥ %.1f", slopes.bar),
                   print("%.2f, the median of %.0f fields", middle,
                         static_cast<double>(slopes.found.size())),
                   middle >= slopes.bar);
    }
}

void orderOfSteps(Summary& summary, const std::vector<Json>& rows) {
    std::vector<Slopes> all;
    const auto slopesOf = [&](const std::string& of) -> Slopes& {
        for (Slopes& slopes : all)
            if (slopes.of == of) return slopes;
        const bool fourth = of.starts_with("sharma") || of.starts_with("rk4");
        const bool cubic = of.find("cubic") != std::string::npos; // linear look-ups have kinks
        all.push_back({of, !cubic ? 0 : fourth ? 3.8 : 1.9, {}});
        return all.back();
    };
    for (const Json& row : partOf(rows, "order")) {
        std::vector<double> steps, errors;
        for (size_t i = 0; i < row["steps"].size(); ++i) {
            steps.push_back(row["steps"][i].get<double>());
            errors.push_back(row["errors"][i].get<double>());
        }
        const std::string of =
            row["integrator"].get<std::string>() +
            (row["plain"].get<bool>() && row["integrator"] != "euler" ? " plain " : " ") +
            row["interpolation"].get<std::string>() + " in the step";
        Slopes& slopes = slopesOf(of);
        if (const auto slope = finestSlope(steps, errors)) slopes.found.push_back(*slope);
    }
    addOrders(summary, all);
}

void orderOfVoxels(Summary& summary, const std::vector<Json>& rows) {
    std::vector<Slopes> all;
    for (const auto& [setting, of, bar] :
         {std::tuple(fixed("verlet", "linear", 0.25), "linear in the voxel", 1.9),
          std::tuple(fixed("sharma", "cubic", 0.5), "cubic in the voxel", 2.9)}) {
        Slopes slopes{of, bar, {}};
        for (const Field& field : fields()) {
            if (!field.smooth) continue;
            std::vector<double> sizes, errors;
            for (const Json& row : partOf(rows, "voxels")) {
                if (row["field"] != field.name ||
                    row["integrator"] != setting.key()["integrator"] ||
                    row["step"] != setting.key()["step"])
                    continue;
                sizes.push_back(1 / row["voxels"].get<double>());
                errors.push_back(row["rms"].get<double>());
            }
            if (const auto slope = finestSlope(sizes, errors)) slopes.found.push_back(*slope);
        }
        all.push_back(slopes);
    }
    addOrders(summary, all);
}

/// The largest deviation in the first half of the turns and in the second: errors that drift at an
/// even pace double, errors that swing do not grow.
void judgeOrbits(Summary& summary, const std::vector<Json>& rows) {
    for (const Json& row : partOf(rows, "orbit")) {
        double early = 0, late = 0, drift = 0;
        for (size_t i = 0; i < row["turns"].size(); ++i) {
            double& most = row["turns"][i].get<double>() <= 5 ? early : late;
            most = std::max(most, row["off"][i].get<double>());
            drift = std::max(drift, row["drift"][i].get<double>());
        }
        const std::string of = row["label"];
        summary.orbits.push_back({{"of", of}, {"early", early}, {"late", late}, {"drift", drift}});
        if (row["integrator"] == "verlet")
            addBar(summary, of + ": bounded",
                   print("off by %.2g voxels in turns 1 to 5, %.2g in 6 to 10", early, late),
                   late <= std::max(1.5 * early, kFloatsOfOrbits));
    }
}

void judgeNoise(Summary& summary, const std::vector<Json>& rows) {
    std::vector<double> photons, noise;
    for (const Json& row : partOf(rows, "photons")) {
        if (!row["label"].get<std::string>().starts_with("default")) continue;
        photons.push_back(row["photons"].get<double>());
        noise.push_back(row["noise"].get<double>());
    }
    if (photons.size() < 2) return;
    const double slope = slopeOf(photons, noise);
    addBar(summary, "noise of the fluence falls as photons^-0.5 or faster",
           print("photons^%.2f", slope), slope <= -0.5);
}

} // namespace

void addBar(Summary& summary, const std::string& bar, const std::string& found, bool met) {
    summary.bars.push_back({{"bar", bar}, {"found", found}, {"met", met}});
}

double slopeOf(const std::vector<double>& x, const std::vector<double>& y) {
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    const auto n = static_cast<double>(x.size());
    for (size_t i = 0; i < x.size(); ++i) {
        const double a = std::log(x[i]), b = std::log(y[i]);
        sx += a, sy += b, sxx += a * a, sxy += a * b;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

std::vector<Json> partOf(const std::vector<Json>& rows, const std::string& part) {
    std::vector<Json> found;
    for (const Json& row : rows)
        if (row["part"] == part) found.push_back(row);
    return found;
}

Summary summarise(const std::vector<Json>& rows) {
    Summary summary;
    addSettings(summary, rows);
    addFrontier(summary);
    judgeSettings(summary, rows);
    orderOfSteps(summary, rows);
    orderOfVoxels(summary, rows);
    judgeOrbits(summary, rows);
    judgeNoise(summary, rows);
    judgeSharp(summary, rows);
    judgeImages(summary, rows);
    return summary;
}

} // namespace accuracy
