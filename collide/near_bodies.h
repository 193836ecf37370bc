#pragma once
// The broad phase of bodies: strips of boxes, each swept along its length, and a test of the spheres around them.

#include "collide/strip_boxes.h"
#include "collide/vertex_kernels.h"
#include "collide/workers.h"

namespace collide {

class NearBodies {
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
  struct alignas(64) Thread {
    std::vector<Index> found, count;  // of each row: how many, and their places in the order
    std::uint64_t near_boxes;
  };
  /// Strips have the width of the widest box and reach, so that a box meets its own strip and some of the next.
  struct Strip {
    Index begin, end;  // places
    float widest;      // of its boxes, along
  };
  void sort(std::span<const Bound> bounds, std::span<const Index> live, float reach);
  std::size_t strip_of(double value) const;
  void find_row(Thread& own, Index place, float reach) const;
  void group(std::size_t bodies, std::size_t most_pairs);

  StripBoxes boxes_;
  int across_ = 0;  // the axis that the strips divide
  double first_edge_ = 0, width_ = 1;
  std::vector<Strip> strips_;
  struct Place {
    std::uint64_t key;  // sorts by strip, then as lo[along] does
    Index body;
  };
  std::vector<Place> order_;
  std::vector<Thread> threads_;
  std::vector<std::uint32_t> first_;  // bodies + 1 offsets into other_
  std::vector<Index> other_;
  std::vector<bool> in_pair_;
  std::uint64_t near_boxes_ = 0, alone_ = 0;
};

}  // namespace collide
