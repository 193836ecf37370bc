#pragma once
// Shapes as signed distances: negative inside. After Quilez, "Distance functions".

#include <functional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace shapes {

/// A distance in m, never more than the true one where it is not exact.
using Distance = std::function<double(const glm::dvec3&)>;

/// Returns all points within two balls and the cone that touches both. No ball contains the other.
Distance round_cone(const glm::dvec3& a, double radius_a, const glm::dvec3& b, double radius_b);

/// Returns an ellipsoid, which `long_axis` is turned to from y.
Distance ellipsoid(const glm::dvec3& centre, const glm::dvec3& radii, const glm::dvec3& long_axis = {0, 1, 0});

/// Returns the tube around a closed line of points.
Distance tube(const std::vector<glm::dvec3>& line, double radius);

/// Returns the solid of revolution around y of a tube around an open line, in (distance from the axis, y).
Distance revolved(const std::vector<glm::dvec2>& line, double radius);

/// Returns the union. Where two shapes are within about `width` of each other, the edge between them is rounded.
Distance smooth_union(std::vector<Distance> parts, double width);

}  // namespace shapes
