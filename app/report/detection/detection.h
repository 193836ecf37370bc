#pragma once

#include "app/report/report.h"

namespace app {

/// Sweeps every method over its settings on recorded states of the scenes and writes detection.csv, report.md and the
/// plots into options.out; nothing before all is measured. Throws UsageError and SceneError.
void report_detection(const ReportOptions& options);

}  // namespace app
