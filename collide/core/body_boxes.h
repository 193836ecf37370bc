#pragma once
// First stage of every method: the bodies' bounding boxes (§2.1), and which bodies take part at all.

#include "collide/core/aabb.h"
#include "collide/core/detector.h"

namespace collide {

struct BodyBoxes {
  std::vector<Aabb> box;    // of every body; meaningless unless the body is live
  std::vector<Index> live;  // bodies with vertices, all of them finite; ascending

  /// Starts the result afresh and names the bodies that are not finite in it.
  void build(const Frame& frame, Result& result);
};

struct BodyPair {
  Index a, b;  // a < b
};

/// Every two live bodies whose boxes are within the cutoff of each other (see contact_cutoff).
class BodyPairs {
 public:
  static constexpr std::size_t max_pairs = std::size_t{1} << 27;  // 1 GiB of them

  /// Throws std::length_error at more than limit.
  const std::vector<BodyPair>& find(const BodyBoxes& bodies, float cutoff, std::size_t limit = max_pairs);

 private:
  std::vector<Index> order_;
  std::vector<BodyPair> pairs_;
};

}  // namespace collide
