#pragma once
// The boxes, cells and buckets of a detection, for drawing.

#include <compare>

#include "collide/core/frame.h"

namespace collide {

struct BucketLoad {
  std::uint32_t bucket, load;  // load: the number of entries
  auto operator<=>(const BucketLoad&) const = default;
};

/// What a detector has built, for drawing. Filled only on request.
struct DebugGeometry {
  struct Box {
    glm::vec3 lo, hi;
    Index body;
  };
  struct Cell {
    std::array<std::int64_t, 3> index;  // covers [index * cell_size, (index + 1) * cell_size) along each axis
    std::uint32_t bucket;
    auto operator<=>(const Cell&) const = default;
  };
  std::vector<Box> boxes;                   // the boxes that the method hashes, or the areas that it searches
  std::vector<Index> vertices;              // the vertices that it hashes one by one, if it does
  std::vector<std::uint32_t> box_first{0};  // boxes.size() + 1 offsets into box_bucket
  std::vector<std::uint32_t> box_bucket;    // the buckets of each box, in the order in which it was hashed: the
                                            // bucket of its minimum corner comes first (§2.2)
  std::vector<Cell> cells;                  // occupied cells, ascending, no duplicates; at most debug_cell_limit
  std::uint32_t buckets = 0;                // size of the table; 0 if the method hashes nothing
  std::vector<BucketLoad> loads;            // one entry for each used bucket, in any order
  static constexpr std::size_t debug_cell_limit = 200'000;
};

}  // namespace collide
