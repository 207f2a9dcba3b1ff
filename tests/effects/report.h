// What `make effects` measures, and the page of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "effects.h"

#include <nlohmann/json.hpp>

namespace effects {

using Json = nlohmann::ordered_json;

/// Files are made in `work`.
Json measure(const Scale& scale, int rounds, const std::string& work);
std::string pageOf(const Json& results);

} // namespace effects
