// Refraction in image space: its rows, its bars, its part of the page.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "rays.h"
#include "report.h"

namespace accuracy {

std::vector<Task> imageTasks(Bench& bench);

void judgeImages(Summary& summary, const std::vector<Json>& rows);
std::string imageSection(const std::vector<Json>& rows);

} // namespace accuracy
