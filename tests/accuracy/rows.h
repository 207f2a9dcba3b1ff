// Measurements as rows of a file: each is made once, kept as soon as made, and found again.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace accuracy {

using Json = nlohmann::ordered_json;

/// One measurement that may be wanted: `key` has the knobs that it depends on, all of them.
struct Task {
    Json key;
    std::string label; ///< for people
    std::function<Json()> measure;
};

/// Middle of an odd number of values.
double median(std::vector<double> values);

/// A hash of the library's file and of the shaders that EIKONAL_SHADERS may put in their place.
std::string libraryVersion();

/// Measures what the file of rows lacks, in order, and appends each row as soon as it is there: a
/// run that is stopped loses the row it was at. Gives one object per task, key and values in one.
std::vector<Json> runTasks(const std::vector<Task>& tasks, const std::string& file);

/// Numbers that several rows are compared with, kept in a file of that folder.
std::vector<float> kept(const std::string& folder, const Json& key,
                        const std::function<std::vector<float>()>& make);

} // namespace accuracy
