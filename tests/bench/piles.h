#pragma once
// Where the states come from: scenes of the project, simulated until the bodies lie in a pile and then set in motion,
// or recorded as they move by themselves.

#include <functional>
#include <span>
#include <string_view>

#include "tests/bench/states.h"

namespace bench {

struct Pile {
  std::string_view key;
  std::string_view what;  // one phrase
  int bodies;
  State (*make)(int threads);
};

std::span<const Pile> piles();

inline constexpr int recorded_frames = 8;  // of a pile that is set in motion
/// Mean distance in metres that a vertex moves in one frame there.
inline constexpr double motion = 0.022 * mean_edge;

}  // namespace bench
