// How far a run is, on standard error: a bar for people, lines for render farms.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/progress_line.h"

#include "base/standard_error.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace eikonal::tool {

namespace {

double nowSeconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

} // namespace

std::string clockText(double seconds) {
    const auto whole = static_cast<long long>(std::ceil(std::clamp(seconds, 0.0, 1e9)));
    char text[32];
    if (whole >= 3600)
        std::snprintf(text, sizeof text, "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60,
                      whole % 60);
    else
        std::snprintf(text, sizeof text, "%lld:%02lld", whole / 60, whole % 60);
    return text;
}

ProgressLine::ProgressLine(const std::string& tool, const std::string& mode)
    : mTool(tool), mMode(mode), mBar((mode.empty() || mode == "text") && tellsTerminal()),
      mBegan(nowSeconds()), mTold(mBegan) {}

void ProgressLine::operator()(double fraction) {
    fraction = std::clamp(fraction, 0.0, 1.0);
    const int percent = static_cast<int>(fraction * 100 + 1e-9);
    const bool people = mMode.empty() || mMode == "text";
    if (people) return tellPeople(fraction, percent);
    if (percent <= mPercent) return;
    mPercent = percent;
    char line[160];
    if (mMode == "alf")
        std::snprintf(line, sizeof line, "ALF_PROGRESS %d%%\n", percent);
    else if (mMode == "openjd")
        std::snprintf(line, sizeof line, "openjd_progress: %d\n", percent);
    else
        std::snprintf(line, sizeof line, "{\"tool\":\"%s\",\"progress\":%.2f}\n", mTool.c_str(),
                      percent / 100.0);
    tell(line);
}

void ProgressLine::tellPeople(double fraction, int percent) {
    const double now = nowSeconds();
    const bool done = fraction >= 1;
    if (mPercent == 100 || (!done && now - mTold < 1)) return;
    mTold = now;
    mPercent = percent;
    const double spent = now - mBegan;
    const std::string time = done           ? clockText(spent) + " taken"
                             : fraction > 0 ? clockText(spent * (1 - fraction) / fraction) + " left"
                                            : "";
    char line[200];
    if (mBar) {
        const std::string full(static_cast<size_t>(percent / 2), '#');
        // What a longer text before left standing is written over.
        std::snprintf(line, sizeof line, "\r%s [%-50s] %3d%% %-14s", mTool.c_str(), full.c_str(),
                      percent, time.c_str());
        mOpen = true;
    } else {
        std::snprintf(line, sizeof line, "%s: %d%% %s\n", mTool.c_str(), percent, time.c_str());
    }
    tell(line);
}

void ProgressLine::end() {
    if (mOpen) tell("\n");
    mOpen = false;
}

} // namespace eikonal::tool
