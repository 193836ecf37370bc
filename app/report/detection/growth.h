#pragma once

#include <string>
#include <vector>

#include "app/report/detection/plots.h"

namespace app {

/// The part of the report on what §3 of the paper claims: hashes by level, and growth with the number of bodies.
std::string growth_markdown(const DetectionResults& results, const std::vector<Plot>& plots);

}  // namespace app
