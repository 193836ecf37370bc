#pragma once
// The contents of a hash table, bucket by bucket: which entries share a grid cell, and which only the bucket (§2.2).

#include <optional>
#include <vector>

#include "collide/methods/cell_hash.h"

namespace app::compare {

using Cell = collide::methods::CellHash::Cell;

/// An entry of the table: a box in the cell of one of its corners, or a vertex in its cell.
struct TableEntry {
  std::uint32_t bucket;
  Cell cell;
  collide::Index item;  // index in DebugGeometry::boxes; a vertex if the method hashes vertices
  auto operator<=>(const TableEntry&) const = default;
};

/// Counts the pairs of entries in a bucket. Two entries of one box are not a pair.
struct Sharing {
  std::uint64_t same_cell = 0;  // in the same cell
  std::uint64_t aliased = 0;    // in different cells that the modulo maps to one bucket
};

struct CellGroup {
  Cell cell;
  std::vector<collide::Index> items;  // ascending
};

struct BucketContents {
  std::uint32_t bucket = 0;
  bool vertices = false;            // the items are vertices, else boxes
  std::vector<CellGroup> groups{};  // by cell, the fullest first
  std::size_t items = 0;            // each counted once
  Sharing sharing{};

  /// Returns the group of `cell`; the fullest group if there is none; nullptr if the bucket is empty.
  const CellGroup* group(const std::optional<Cell>& cell) const;
};

class TableContents {
 public:
  TableContents() = default;
  /// debug: the geometry of a method with a table, on this frame, which must be complete, with these
  /// settings.
  TableContents(const collide::DebugGeometry& debug, const collide::Frame& frame, const collide::Settings& settings);

  BucketContents bucket(std::uint32_t number) const;
  /// Returns the sum over all buckets.
  const Sharing& sharing() const { return sharing_; }

 private:
  std::vector<TableEntry> entries_;  // ascending
  bool entries_are_vertices_ = false;
  Sharing sharing_;
};

/// Returns the eight corners of a box in the order in which §2.2 hashes them: the minimum first, z fastest.
std::array<glm::vec3, 8> corners_of(const collide::DebugGeometry::Box& box);

/// Returns the bodies of the entries of one cell: "body 3", "bodies 0, 3 and 7", "bodies 0, 3 and 12 more".
std::string bodies_text(const CellGroup& group, const BucketContents& bucket, const collide::DebugGeometry& debug,
                        const collide::Bodies& of_world);

/// Returns "(0, -1, 2)".
std::string cell_text(const Cell& cell);

/// Returns "12 near, 3 by chance": the pairs in the same cell, and the aliased ones.
std::string sharing_text(const Sharing& sharing);

}  // namespace app::compare
