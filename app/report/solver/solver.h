#pragma once

#include "app/report/report.h"

namespace app {

/// `report solver`: what each integrator's error is, and what it costs. Throws UsageError and SceneError before
/// anything runs.
void report_solver(const ReportOptions& options);

}  // namespace app
