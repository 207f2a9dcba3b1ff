// What the rows amount to: bars, frontier, tables, data for plots.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "rays.h"

namespace accuracy {

struct Summary {
    Json bars = Json::array();     ///< {bar, found, met}
    Json settings = Json::array(); ///< view rays: {label, options, error, ...}
    Json frontier = Json::array(); ///< those of `settings` that nothing beats in both
    Json orders = Json::array();   ///< {of, order, least, most}
    Json orbits = Json::array();   ///< {of, early, late, drift}
    std::string second, third;     ///< labels of what is recommended beside the default
};
Summary summarise(const std::vector<Json>& rows);

void addBar(Summary& summary, const std::string& bar, const std::string& found, bool met);

/// Sharp boundaries: their bars, their part of the page, error against time for the plot.
void judgeSharp(Summary& summary, const std::vector<Json>& rows);
std::string sharpSection(const std::vector<Json>& rows);
std::string sharpCsv(const std::vector<Json>& rows);

/// Least-squares slope of log y over log x.
double slopeOf(const std::vector<double>& x, const std::vector<double>& y);
/// Those rows of one part.
std::vector<Json> partOf(const std::vector<Json>& rows, const std::string& part);

/// Files of comma-separated values by name.
std::map<std::string, std::string> plotData(const std::vector<Json>& rows, const Summary& summary);

/// docs/accuracy.md.
std::string pageOf(const std::vector<Json>& rows, const Summary& summary, const Bench& bench);

} // namespace accuracy
