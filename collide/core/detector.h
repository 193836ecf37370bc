#pragma once
// The interface of every detector.

#include <compare>

#include "collide/core/frame.h"
#include "collide/core/result.h"
#include "collide/core/settings.h"
#include "collide/core/workers.h"

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

/// Finds the contacts of one frame after another. Keeps scratch memory and, where the method reuses them, results of
/// earlier frames. Bodies may come and go between frames. Deterministic: the result does not depend on the workers.
class Detector {
 public:
  virtual ~Detector() = default;
  /// Overwrites `result` with the contacts of the frame. Preconditions: problem(settings) is empty, is_complete(frame).
  /// Throws std::length_error if the method would need more memory than it may take.
  virtual void detect(const Frame& frame, const Settings& settings, Workers& workers, Result& result) = 0;
  /// Drops the results of earlier frames, so that the next frame is found from scratch. Keeps the scratch memory.
  virtual void forget() {}
  /// Returns what the last detect() built; empty for methods that build no boxes and no table.
  virtual DebugGeometry debug() const { return {}; }
};

}  // namespace collide
