#pragma once
// The broad phase: which bodies are near each other. Sorts the bodies' boxes into strips and cells, sweeps along the
// strips, and then tests the bounding spheres.

#include "collide/core/vertex_kernels.h"
#include "collide/core/workers.h"
#include "collide/exact/sweep_strips.h"

namespace collide::exact {

class BodyBroadPhase {
 public:
  /// Finds all pairs of `live` bodies whose boxes are near() and whose bounding spheres are within the cutoff (m) of
  /// each other. bounds: of all bodies of the frame. live: the bodies to look at; ascending. Throws std::length_error
  /// if there are more than `limit` pairs.
  void find(std::span<const BodyBounds> bounds, std::span<const Index> live, float cutoff, Workers& workers,
            std::size_t limit = max_pairs);

  /// Returns the bodies near `body` that have a greater number; ascending.
  std::span<const Index> later_neighbours(Index body) const {
    return {other_.data() + first_[body], other_.data() + first_[body + std::size_t{1}]};
  }
  std::size_t pairs() const { return other_.size(); }
  /// Returns how many pairs have a first body below `body`.
  std::size_t pairs_before(Index body) const { return first_[body]; }
  /// Returns how many pairs of bodies have boxes that are near(), whatever their spheres.
  std::uint64_t near_box_pairs() const { return near_box_pairs_; }
  /// Returns how many live bodies are in no pair.
  std::uint64_t isolated_bodies() const { return isolated_bodies_; }

  static constexpr std::size_t max_pairs = std::size_t{1} << 27;  // 512 MiB of them

 private:
  /// Equal intervals along an axis.
  struct Parts {
    double first = 0, width = 1;
    std::size_t count = 1;
    /// Returns the interval of a coordinate. Monotonic: a greater coordinate never has a smaller interval.
    std::size_t of(double value) const;
  };
  struct alignas(64) Thread {
    std::vector<Index> found, count;  // the places found for each box in turn, and how many they are
    std::uint64_t near_box_pairs;
  };
  void divide(std::span<const BodyBounds> bounds, std::span<const Index> live, float cutoff);
  void place(std::span<const BodyBounds> bounds, std::span<const Index> live);
  void find_row(Thread& own, Index place, float cutoff) const;
  void group(std::size_t bodies, std::size_t limit);

  // A box lies in the strip and the cell of its minimum corner. A strip is as wide as the widest box plus the cutoff,
  // so a box can only meet boxes of its own strip and of the next one. The cells along a strip are narrow.
  Parts strips_, cells_;
  int across_ = 0, along_ = 0;     // the axes that strips_ and cells_ divide
  std::vector<double> widest_;     // the largest extent along the strip of each strip's boxes
  std::vector<Index> cell_begin_;  // strip by strip: the first place of each cell, and the end of the last cell
  std::vector<Index> cell_;        // of each live body
  SweepStrips boxes_;              // by place
  std::vector<Index> body_;        // by place
  std::vector<Thread> threads_;
  std::vector<std::uint32_t> first_;  // (bodies + 1) offsets into other_
  std::vector<Index> other_;
  std::vector<std::uint8_t> in_pair_;
  std::uint64_t near_box_pairs_ = 0, isolated_bodies_ = 0;
};

}  // namespace collide::exact
