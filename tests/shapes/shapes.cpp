#include "tests/shapes/shapes.h"

#include <cmath>
#include <numbers>

namespace shapes {

using glm::dvec2, glm::dvec3;
using std::numbers::pi;

Distance creature() {
  std::vector<Distance> parts{
      round_cone({-0.30, 0.52, 0}, 0.215, {0.24, 0.55, 0}, 0.235),  // trunk
      round_cone({0.30, 0.66, 0}, 0.16, {0.46, 0.92, 0}, 0.13),     // neck
      ellipsoid({0.50, 0.98, 0}, {0.20, 0.18, 0.19}),               // head
      round_cone({0.58, 0.94, 0}, 0.125, {0.745, 0.885, 0}, 0.09),  // snout
      round_cone({-0.46, 0.60, 0}, 0.07, {-0.62, 0.72, 0}, 0.055),  // tail
      round_cone({-0.62, 0.72, 0}, 0.055, {-0.66, 0.88, 0}, 0.065),
  };
  for (const double side : {-1.0, 1.0}) {
    parts.push_back(ellipsoid({0.40, 1.23, side * 0.15}, {0.055, 0.23, 0.095}, {-0.3, 1, side * 0.35}));  // ear
    for (const double x : {-0.34, 0.27}) {
      parts.push_back(round_cone({x, 0.45, side * 0.12}, 0.12, {x, 0.09, side * 0.155}, 0.08));
      parts.push_back(ellipsoid({x + 0.035, 0.065, side * 0.155}, {0.12, 0.065, 0.09}));
    }
  }
  std::vector<Distance> with_face{smooth_union(std::move(parts), 0.09)};
  for (const double side : {-1.0, 1.0}) with_face.push_back(ellipsoid({0.625, 1.055, side * 0.1}, dvec3(0.04)));
  with_face.push_back(ellipsoid({0.835, 0.90, 0}, {0.03, 0.03, 0.04}));  // nose
  return smooth_union(std::move(with_face), 0.02);
}

Distance torus_knot() {
  std::vector<dvec3> line;
  constexpr int points = 300;
  for (int i = 0; i < points; ++i) {
    const double t = 2 * pi * i / points, out = 0.38 + 0.19 * std::cos(3 * t);
    line.emplace_back(out * std::cos(2 * t), 0.19 * std::sin(3 * t), out * std::sin(2 * t));
  }
  return tube(line, 0.085);
}

Distance bowl() {
  std::vector<dvec2> wall;
  constexpr int points = 60;
  for (int i = 0; i <= points; ++i) {
    const double angle = 1.35 * i / points;  // from straight below the middle
    wall.emplace_back(std::sin(angle), 1.05 - std::cos(angle));
  }
  return smooth_union({revolved(wall, 0.07), revolved({{0.38, 0.03}, {0.36, 0.09}}, 0.06)}, 0.08);
}

}  // namespace shapes
