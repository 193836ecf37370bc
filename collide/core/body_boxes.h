#pragma once
// The first stage of every method but the exact one: the bounding boxes of the bodies (§2.1), and which bodies take
// part.

#include "collide/core/aabb.h"
#include "collide/core/detector.h"

namespace collide {

struct BodyBoxes {
  std::vector<Aabb> box;    // of every body; only those of live bodies mean anything
  std::vector<Index> live;  // the bodies that have vertices, all of them finite; ascending

  /// Computes the boxes of a frame. Clears the result and lists the bodies that are not finite in it.
  void build(const Frame& frame, Result& result);
};

struct BodyPair {
  Index a, b;  // a < b
};

/// Finds the pairs of live bodies whose boxes are near().
class BodyPairs {
 public:
  static constexpr std::size_t max_pairs = std::size_t{1} << 27;  // 1 GiB of them

  /// cutoff: m, see contact_cutoff(). Throws std::length_error if there are more than `limit` pairs.
  const std::vector<BodyPair>& find(const BodyBoxes& bodies, float cutoff, std::size_t limit = max_pairs);

 private:
  std::vector<Index> order_;
  std::vector<BodyPair> pairs_;
};

}  // namespace collide
