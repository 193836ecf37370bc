#include "collide/surface/box_tree.h"

namespace collide::surface {

BoxTree::BoxTree(const std::vector<Box>& boxes) {
  std::vector<Index> items;
  items.reserve(boxes.size());
  for (Index item = 0; item < boxes.size(); ++item) {
    if (!boxes[item].empty()) items.push_back(item);
  }
  nodes_.reserve(2 * items.size());
  if (!items.empty()) build(boxes, items.begin(), items.end());
}

void BoxTree::build(const std::vector<Box>& boxes, Iterator begin, Iterator end) {
  const std::size_t self = nodes_.size();
  nodes_.push_back({{}, 0, *begin});
  Box all;
  for (Iterator it = begin; it != end; ++it) all.add(boxes[*it]);
  if (end - begin > 1) {
    const glm::dvec3 size = all.hi - all.lo;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto centre2 = [&](Index item) { return boxes[item].lo[axis] + boxes[item].hi[axis]; };
    const Iterator half = begin + (end - begin) / 2;
    std::nth_element(begin, half, end, [&](Index a, Index b) { return centre2(a) < centre2(b); });
    build(boxes, begin, half);
    build(boxes, half, end);
  }
  nodes_[self].box = all;
  nodes_[self].end = static_cast<Index>(nodes_.size());
}

}  // namespace collide::surface
