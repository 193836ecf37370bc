#pragma once
// The shapes of assets/meshes that make_shapes makes.

#include <array>
#include <string_view>

#include "tests/shapes/distance.h"

namespace shapes {

struct Shape {
  std::string_view name;  // of its file
  int vertices;           // about as many has the file
  Distance (*make)();
};

Distance creature();    // with four legs, two ears and a tail, 1.2 m long
Distance torus_knot();  // the trefoil, 1.3 m wide
Distance bowl();        // 2 m wide, on a foot

inline constexpr std::array shapes{Shape{"creature", 12'000, creature}, Shape{"torus-knot", 10'000, torus_knot},
                                   Shape{"bowl", 8'000, bowl}};

}  // namespace shapes
