#pragma once

#include "app/report/report.h"

namespace app {

/// `report stability`: extreme cases by integrator, length of a frame and stiffness, and what fails. Throws UsageError
/// and SceneError before anything runs.
void report_stability(const ReportOptions& options);

}  // namespace app
