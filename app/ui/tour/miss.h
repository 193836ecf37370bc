#pragma once
// Why the paper's method misses a contact.

#include <array>
#include <optional>

#include <glm/vec3.hpp>

#include "app/compare/table_contents.h"

namespace app::ui {

struct HashedCorner {
  glm::vec3 at;  // m
  compare::Cell cell;
  std::uint32_t bucket;
};

HashedCorner hash_corner(const glm::vec3& at, const collide::methods::CellHash& hash);

/// A face between two layers of cells.
struct CellFace {
  int axis;
  std::int64_t index;  // of the cells above it: it lies at index * cell size
};

/// A missed contact. The arrays are of its first and its second vertex.
struct ExplainedMiss {
  collide::Contact contact;
  std::array<glm::vec3, 2> at;  // m, the vertices
  std::array<collide::Index, 2> bodies, boxes;
  std::array<HashedCorner, 2>
      corners;  // one of each box: of those whose cells are nearest, the nearest to the vertices
  // One of these:
  std::optional<CellFace> face;          // between the boxes
  std::optional<compare::Cell> skipped;  // both boxes reach over it, but the corners of one or both are elsewhere
};

/// Precondition: missed_contacts() returns the contact.
ExplainedMiss explain_miss(const collide::Contact& contact, const collide::DebugGeometry& structure,
                           const collide::Frame& frame, const collide::methods::CellHash& hash);

}  // namespace app::ui
