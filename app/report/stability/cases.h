#pragma once
// The extreme cases of `report stability`.

#include <span>
#include <string_view>

#include "app/report/solver/scenes.h"

namespace app::report {

/// A case at one stiffness.
struct StabilityScene {
  softbody::Scene scene{};
  std::vector<Particles> start{};  // per body; empty: as the scene has it
  double first_frame = 0;          // s: one frame of this length comes first; 0: none
};

struct StabilityCase {
  std::string_view key, name;
  StabilityScene (*make)(double stiffness);  // N/m
};

std::span<const StabilityCase> stability_cases();

/// Returns the scene with all its stiffnesses and pressures times a factor.
StabilityScene scaled(softbody::Scene scene, double factor);

}  // namespace app::report
