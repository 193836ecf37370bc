#pragma once
// One cell of the report: an extreme case at one stiffness, run by one integrator with frames of one length.

#include <span>
#include <vector>

#include "app/report/stability/start.h"

namespace app::report {

/// Runs and judges a cell. A named integrator takes one step of its own per frame; `auto` chooses its steps. `dt`: s,
/// the length of a frame.
reference::StabilityFigures run_cell(const StabilityStart& start, const softbody::Integrator& integrator, double dt);

}  // namespace app::report
