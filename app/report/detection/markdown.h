#pragma once

#include <string>
#include <vector>

#include "app/report/detection/results.h"
#include "app/report/plot.h"

namespace app {

/// The report as Markdown. plots: those that lie beside it as NAME.svg and NAME.png.
std::string detection_markdown(const DetectionResults& results, const std::vector<Plot>& plots);

}  // namespace app
