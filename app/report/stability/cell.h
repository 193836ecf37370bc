#pragma once
// One cell of the report: an extreme case at one stiffness, run by one integrator with frames of one length.

#include <span>
#include <vector>

#include "app/report/stability/start.h"

namespace app::report {

/// Runs and judges a cell. A named integrator takes one step of its own per frame; `auto` chooses its steps. `dt`: s,
/// the length of a frame.
reference::StabilityFigures run_cell(const StabilityStart& start, const softbody::Integrator& integrator, double dt);

/// Returns what penalty contacts would store if these bodies joined now, each at its source's position, before a
/// first frame has carried them into others. Leaves the world as it was.
std::vector<softbody::PairEnergy> penalty_energies_with(softbody::World& world,
                                                        std::span<const softbody::BodySource> joiners);

}  // namespace app::report
