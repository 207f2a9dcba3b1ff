// How far a run is, on standard error: a bar for people, lines for render farms.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace eikonal::tool {

class ProgressLine {
public:
    /// `mode` is --progress's, "" for a bar where standard error is a terminal.
    ProgressLine(const std::string& tool, const std::string& mode);

    /// Of what is finished [share]. People hear of it once a second, with the time left as the
    /// time so far suggests it; machines at every percent.
    void operator()(double fraction);

    /// Ends a bar's line, so that what follows begins one.
    void end();

private:
    void tellPeople(double fraction, int percent);

    std::string mTool, mMode;
    bool mBar = false, mOpen = false;
    double mBegan = 0, mTold = 0; // [s]
    int mPercent = -1;
};

/// "0:07", "12:30", "3:05:00" of so many seconds.
std::string clockText(double seconds);

} // namespace eikonal::tool
