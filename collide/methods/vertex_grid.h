#pragma once
// Vertices hashed one by one into a grid (§2.2 without boxes): the common stage of the two grid-hash methods.
// Memory: 36 bytes a vertex and 4 bytes a bucket. However small the cells are, a thread lists at most 64 cells at a
// time, or a 32nd of the number of vertices.

#include "collide/core/body_boxes.h"
#include "collide/core/contact_search.h"
#include "collide/methods/bucket_table.h"
#include "collide/methods/cell_hash.h"

namespace collide::methods {

class VertexGrid {
 public:
  /// Finds all contacts among the vertices of the bodies `which`, at any cell size. Adds the contacts and the counters
  /// to the result.
  void detect(const Frame& frame, std::span<const Index> which, const Settings& settings, Workers& workers,
              Result& result);

  /// Returns the occupied cells and the loads of the buckets.
  DebugGeometry debug() const;

 private:
  struct alignas(64) Thread {
    std::vector<std::uint32_t> buckets;
    std::uint64_t hashes;
  };
  void hash_vertices(const Frame& frame, std::span<const Index> which);
  void visit_cells(int thread, Index slot, double cutoff, const CellHash& hash);

  Settings settings_;
  std::vector<Index> vertex_, body_;   // in the order in which they are hashed
  std::vector<std::uint32_t> bucket_;  // of each of them
  BucketTable table_;
  Points points_;  // bucket by bucket
  std::vector<Thread> threads_;
  ContactSearch search_;
};

}  // namespace collide::methods
