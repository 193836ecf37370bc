#pragma once
// One cell of the matrix: an extreme case at one stiffness, run by one integrator with frames of one length.

#include "app/report/stability/start.h"

namespace app {

/// A named integrator takes one step of its own a frame; `auto` takes those that it likes.
StabilityFigures run_cell(const StabilityStart& start, const softbody::Integrator& integrator, double dt);

}  // namespace app
