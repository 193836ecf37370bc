#pragma once
// The broad phase of bodies: boxes in the cells of strips, and a test of the spheres around them.

#include "collide/core/vertex_kernels.h"
#include "collide/core/workers.h"
#include "collide/exact/sweep_strips.h"

namespace collide::exact {

class BodyBroadPhase {
 public:
  /// Finds every two of the `live` bodies whose boxes are near() and whose spheres are within reach of each other.
  /// bounds: of all bodies. Throws std::length_error at more than most_pairs of them.
  void find(std::span<const Bound> bounds, std::span<const Index> live, float reach, Workers& workers,
            std::size_t most_pairs = max_pairs);

  /// Those near a body that have a greater number than it; ascending.
  std::span<const Index> behind(Index body) const {
    return {other_.data() + first_[body], other_.data() + first_[body + std::size_t{1}]};
  }
  std::size_t pairs() const { return other_.size(); }
  std::size_t pairs_before(Index body) const { return first_[body]; }
  /// Pairs of bodies whose boxes are near(): pairs() and those that only their spheres part.
  std::uint64_t near_boxes() const { return near_boxes_; }
  /// How many of the `live` bodies are in no pair.
  std::uint64_t alone() const { return alone_; }

  static constexpr std::size_t max_pairs = std::size_t{1} << 27;  // 512 MiB of them

 private:
  /// An axis cut into parts of one width.
  struct Parts {
    double first = 0, width = 1;
    std::size_t count = 1;
    /// Never decreases with the value.
    std::size_t of(double value) const;
  };
  struct alignas(64) Thread {
    std::vector<Index> found, count;  // of each row: places, and how many
    std::uint64_t near_boxes;
  };
  void divide(std::span<const Bound> bounds, std::span<const Index> live, float reach);
  void place(std::span<const Bound> bounds, std::span<const Index> live);
  void find_row(Thread& own, Index place, float reach) const;
  void group(std::size_t bodies, std::size_t most_pairs);

  // Boxes lie in the strip and in the cell of their least corner. A strip is as wide as the widest box and reach, so
  // that a box meets its own strip and some of the next; the cells along a strip are narrow.
  Parts strips_, cells_;
  int across_ = 0, along_ = 0;     // the axes that they divide
  std::vector<double> widest_;     // of each strip: of its boxes, along
  std::vector<Index> cell_begin_;  // strip by strip: the place where each cell begins, and the end of the last one
  std::vector<Index> cell_;        // of each live body
  SweepStrips boxes_;              // by place
  std::vector<Index> body_;        // by place
  std::vector<Thread> threads_;
  std::vector<std::uint32_t> first_;  // bodies + 1 offsets into other_
  std::vector<Index> other_;
  std::vector<std::uint8_t> in_pair_;
  std::uint64_t near_boxes_ = 0, alone_ = 0;
};

}  // namespace collide::exact
