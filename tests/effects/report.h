// What `make effects` measures, and the page of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "effects.h"

#include <nlohmann/json.hpp>

namespace effects {

using Json = nlohmann::ordered_json;

/// Measures the family of that name, or all if it is empty, into `results`. Files are made in
/// `work`. Throws std::runtime_error if there is no such family.
void measure(Json& results, const std::string& only, const Scale& scale, int rounds,
             const std::string& work);
std::string pageOf(const Json& results);

} // namespace effects
