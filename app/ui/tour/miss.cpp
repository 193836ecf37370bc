#include "app/ui/tour/miss.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <tuple>

#include "app/ui/tour/paper_boxes.h"

namespace app::ui {
namespace {

using collide::Index;

/// A place along an axis.
struct Place {
  float at;
  std::int64_t index;  // of its cell
};
using Sides = std::array<Place, 2>;  // the lower and the upper side of a box

Sides sides_of(const collide::DebugGeometry::Box& box, int axis, const collide::methods::CellHash& hash) {
  return {Place{box.lo[axis], hash.index(axis, box.lo[axis])}, Place{box.hi[axis], hash.index(axis, box.hi[axis])}};
}

/// Returns a side of each box: the pair with the nearest cells, of these the pair that is nearest to `middle`.
std::array<Place, 2> nearest_sides(const Sides& a, const Sides& b, const Place& middle) {
  const auto gap = [&](const Place& one, const Place& other) {
    return std::tuple(std::abs(one.index - other.index),
                      std::abs(one.index - middle.index) + std::abs(other.index - middle.index),
                      std::abs(one.at - middle.at) + std::abs(other.at - middle.at));
  };
  std::array<Place, 2> nearest{a[0], b[0]};
  for (const Place& one : a)
    for (const Place& other : b)
      if (gap(one, other) < gap(nearest[0], nearest[1])) nearest = {one, other};
  return nearest;
}

}  // namespace

HashedCorner hash_corner(const glm::vec3& at, const collide::methods::CellHash& hash) {
  const compare::Cell cell = hash.cell(at.x, at.y, at.z);
  return {at, cell, hash.bucket(cell)};
}

ExplainedMiss explain_miss(const collide::Contact& contact, const collide::DebugGeometry& structure,
                           const collide::Frame& frame, const collide::methods::CellHash& hash) {
  ExplainedMiss miss{};
  miss.contact = contact;
  const std::array<Index, 2> vertices{contact.a, contact.b};
  for (std::size_t i = 0; i < 2; ++i) {
    miss.at[i] = position(frame, vertices[i]);
    miss.bodies[i] = frame.bodies->body_of(vertices[i]);
    miss.boxes[i] = box_of(structure, miss.bodies[i], miss.at[i]);
  }
  std::array<glm::vec3, 2> corners;
  compare::Cell between{};
  for (int axis = 0; axis < 3; ++axis) {
    const Sides a = sides_of(structure.boxes[miss.boxes[0]], axis, hash);
    const Sides b = sides_of(structure.boxes[miss.boxes[1]], axis, hash);
    const float centre = 0.5f * (miss.at[0][axis] + miss.at[1][axis]);
    const Place middle{centre, hash.index(axis, centre)};
    const auto [of_a, of_b] = nearest_sides(a, b, middle);
    corners[0][axis] = of_a.at;
    corners[1][axis] = of_b.at;
    const std::int64_t low = std::max(a[0].index, b[0].index), high = std::min(a[1].index, b[1].index);
    if (low > high)
      miss.face = {axis, low};
    else
      between[static_cast<std::size_t>(axis)] = std::clamp(middle.index, low, high);
  }
  for (std::size_t i = 0; i < 2; ++i) miss.corners[i] = hash_corner(corners[i], hash);
  assert(miss.corners[0].bucket != miss.corners[1].bucket);
  if (!miss.face) miss.skipped = between;  // no cell has corners of both
  return miss;
}

}  // namespace app::ui
