#pragma once
// The subdivided bounding boxes of §2.1: the box of each body, cut at midpoints into 2^levels regions.
// Memory: empty regions are not kept, so at most 104 bytes a vertex, whatever the level, and 5 * 2^levels bytes a
// thread.

#include "collide/core/body_boxes.h"
#include "collide/core/cuts.h"
#include "collide/core/index_set.h"
#include "collide/core/points.h"

namespace collide::methods {

struct SubdividedBox {
  Aabb region;                             // the region between the cuts, not refitted to the vertices
  std::array<std::uint8_t, 3> interval{};  // which interval of the body's Cuts it is on each axis
  Index body;
  Range slots;  // its vertices, as slots of Subdivision::points()
};

class Subdivision {
 public:
  /// Builds the boxes of the bodies `which`, in their order. Within a body they are sorted by place, x fastest, so that
  /// neighbours are often consecutive. Boxes without vertices are left out. Every vertex is in exactly one box.
  void build(const Frame& frame, const BodyBoxes& bodies, std::span<const Index> which, int levels, Workers& workers);

  const std::vector<SubdividedBox>& boxes() const { return boxes_; }
  const Points& points() const { return points_; }  // box by box

 private:
  struct Thread {
    std::vector<SubdividedBox> boxes;
    std::vector<std::uint32_t> code;  // of each vertex of a body: its interval on each axis, packed
    IndexSet codes_in_use;            // empty, but for the body at hand
    std::vector<Index> of_code;       // 0, but for the body at hand: how many vertices, then the next one's slot
    std::array<Cuts, 3> cuts;
  };
  void cut_body(Thread& own, const Frame& frame, const Aabb& box, Index body, Index first_slot);
  void find_codes(Thread& own, const Frame& frame, Index first, Index size) const;

  int levels_ = 0;
  std::vector<SubdividedBox> boxes_;
  Points points_;
  std::vector<Index> first_slot_;  // of each of the bodies
  std::vector<Thread> threads_;
};

}  // namespace collide::methods
