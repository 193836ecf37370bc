#include "tests/shapes/distance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace shapes {
namespace {

using glm::dvec2, glm::dvec3;

/// Returns the distance to a line segment, in two or three dimensions.
template <class Point>
double to_segment(const Point& p, const Point& a, const Point& b) {
  const Point along = b - a;
  const double t = std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0, 1.0);
  return glm::distance(p, a + t * along);
}

}  // namespace

Distance round_cone(const dvec3& a, double radius_a, const dvec3& b, double radius_b) {
  const double length = glm::distance(a, b), sine = (radius_a - radius_b) / length;
  assert(std::abs(sine) < 1);
  const double cosine = std::sqrt(1 - sine * sine);
  return [=, axis = (b - a) / length](const dvec3& p) {
    const double along = glm::dot(p - a, axis);
    const double across = glm::length(p - a - along * axis);
    const double foot = along * cosine - across * sine;  // along the cone's side
    if (foot <= 0) return glm::distance(p, a) - radius_a;
    if (foot >= length * cosine) return glm::distance(p, b) - radius_b;
    return across * cosine + along * sine - radius_a;
  };
}

Distance ellipsoid(const dvec3& centre, const dvec3& radii, const dvec3& long_axis) {
  const dvec3 y = glm::normalize(long_axis);
  const dvec3 x = glm::normalize(std::abs(y.x) < 0.9 ? dvec3(1, 0, 0) - y.x * y : dvec3(0, 0, 1) - y.z * y);
  const glm::dmat3 turn(x, y, glm::cross(x, y));
  return [=](const dvec3& p) {
    const dvec3 q = (p - centre) * turn;
    const double scaled = glm::length(q / radii), slope = glm::length(q / (radii * radii));
    return slope > 0 ? scaled * (scaled - 1) / slope : -std::min({radii.x, radii.y, radii.z});
  };
}

Distance tube(const std::vector<dvec3>& line, double radius) {
  assert(line.size() > 2);
  return [=](const dvec3& p) {
    double least = INFINITY;
    for (std::size_t i = 0; i < line.size(); ++i)
      least = std::min(least, to_segment(p, line[i], line[(i + 1) % line.size()]));
    return least - radius;
  };
}

Distance revolved(const std::vector<dvec2>& line, double radius) {
  assert(line.size() > 1);
  return [=](const dvec3& p) {
    double least = INFINITY;
    for (std::size_t i = 1; i < line.size(); ++i)
      least = std::min(least, to_segment(dvec2(std::hypot(p.x, p.z), p.y), line[i - 1], line[i]));
    return least - radius;
  };
}

Distance smooth_union(std::vector<Distance> parts, double width) {
  assert(!parts.empty() && width > 0);
  return [parts = std::move(parts), width](const dvec3& p) {
    double joined = parts[0](p);
    for (std::size_t i = 1; i < parts.size(); ++i) {
      const double d = parts[i](p), overlap = std::max(0.0, width - std::abs(d - joined)) / width;
      joined = std::min(d, joined) - overlap * overlap * width / 4;
    }
    return joined;
  };
}

}  // namespace shapes
