#pragma once

#include "app/report/report.h"

namespace app {

/// Runs the scenes and an impact sweep with every contact surface, tolerance and kind of detector, judges them by the
/// surface oracle and writes contact.csv, contact.md and the plots into options.out; nothing before all is measured.
/// Throws UsageError and SceneError.
void report_contact(const ReportOptions& options);

}  // namespace app
