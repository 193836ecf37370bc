#include "app/reference/stability_criteria.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

namespace app::reference {

void StabilityFigures::add(const StabilitySample& s, const StabilityLimits& limits) {
  const double depth = s.depth / limits.radius;
  // std::max would ignore NaN.
  const auto is_finite = [](double figure) { return std::isfinite(figure); };
  finite = s.finite && std::ranges::all_of(std::array{s.excess, s.speed, s.extent, depth}, is_finite);
  if (!finite) {
    blow_up_time = s.time;
    return;
  }
  energy = std::max(energy, s.excess);
  speed = std::max(speed, s.speed);
  extent = std::max(extent, s.extent);
  constexpr int frames_to_come_out = 10;
  if (!limits.begins_inside || s.frame > frames_to_come_out) transient = std::max(transient, depth);
  if (s.time > 0.75 * limits.seconds) steady = std::max(steady, depth);
  passed_through = s.passed_through;
  if (s.excess > 10) blow_up_time = s.time;
}

std::vector<std::string> failures(const StabilityFigures& f) {
  constexpr StabilityBounds b = stability_bounds;
  if (!f.refused.empty()) return {fmt::format("refused: {}", f.refused)};
  std::vector<std::string> all;
  const auto check = [&](bool good, const std::string& text) {
    if (!good) all.push_back(text);
  };
  check(f.finite, "not finite");
  check(f.energy <= b.energy, fmt::format("energy + {:.2g}", f.energy));
  check(f.speed <= b.speed, fmt::format("speed {:.2g} of what energy can give", f.speed));
  check(f.extent <= b.extent, fmt::format("box {:.2g} of what energy can draw", f.extent));
  check(f.transient <= b.transient, fmt::format("{:.2g} R deep in a solid", f.transient));
  check(f.steady <= b.steady, fmt::format("{:.2g} R deep in a solid in the end", f.steady));
  check(f.passed_through == 0, fmt::format("through a solid: {}", f.passed_through));
  if (f.blow_up_time > 0) all.push_back(fmt::format("gave up at {:.3g} s", f.blow_up_time));
  if (!f.reference || f.blow_up_time > 0) return all;
  check(f.reference->shape <= b.shape, fmt::format("shape off by {:.2g} R", f.reference->shape));
  check(f.reference->volume <= b.volume, fmt::format("volume off by {:.2g} %", 100 * f.reference->volume));
  check(f.reference->rest <= b.rest, fmt::format("moves by {:.2g} m/s too fast", f.reference->rest));
  return all;
}

}  // namespace app::reference
