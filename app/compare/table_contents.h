#pragma once
// What a hash table holds, bucket by bucket: which entries share a grid cell, and which only the bucket (§2.2).

#include <optional>
#include <vector>

#include "collide/methods/cell_hash.h"

namespace app {

using Cell = collide::methods::CellHash::Cell;

/// A box in the cell of one of its corners, or a vertex in its cell.
struct TableEntry {
  std::uint32_t bucket;
  Cell cell;
  collide::Index item;  // of DebugGeometry::boxes; a vertex if the method hashes vertices
  auto operator<=>(const TableEntry&) const = default;
};

/// Meetings of two entries in a bucket, each pair once; a box does not meet itself.
struct Sharing {
  std::uint64_t same_cell = 0;  // true neighbours
  std::uint64_t aliased = 0;    // of different cells, which the modulo puts into one bucket
};

struct CellGroup {
  Cell cell;
  std::vector<collide::Index> items;  // ascending
};

struct BucketContents {
  std::uint32_t bucket = 0;
  bool vertices = false;            // the items are vertices, else boxes
  std::vector<CellGroup> groups{};  // one a cell, the fullest first
  std::size_t items = 0;            // each counted once
  Sharing sharing{};

  /// The group of a cell, or else the fullest; nullptr if the bucket is empty.
  const CellGroup* group(const std::optional<Cell>& cell) const;
};

class TableContents {
 public:
  TableContents() = default;
  /// debug: of a method with a table, on this frame with these settings.
  TableContents(const collide::DebugGeometry& debug, const collide::Frame& frame, const collide::Settings& settings);

  BucketContents bucket(std::uint32_t number) const;
  /// Over all buckets.
  const Sharing& sharing() const { return sharing_; }

 private:
  std::vector<TableEntry> entries_;  // ascending
  bool vertices_ = false;
  Sharing sharing_;
};

/// The eight corner points of a box, the minimum point first and z fastest, as §2.2 hashes them.
std::array<glm::vec3, 8> corners_of(const collide::DebugGeometry::Box& box);

}  // namespace app
