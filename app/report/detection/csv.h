#pragma once

#include <string>

#include "app/report/detection/results.h"

namespace app {

/// Every row of every state as CSV (RFC 4180 but for the line ends, which are "\n"), with a header line. What a
/// method has no use for, and what was not measured, is empty.
std::string detection_csv(const DetectionResults& results);

}  // namespace app
