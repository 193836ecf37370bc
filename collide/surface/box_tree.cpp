#include "collide/surface/box_tree.h"

namespace collide::surface {

template <class Bounds>
BoundsTree<Bounds>::BoundsTree(const std::vector<Bounds>& boxes) {
  std::vector<Index> items;
  items.reserve(boxes.size());
  for (Index item = 0; item < boxes.size(); ++item) {
    if (!boxes[item].empty()) items.push_back(item);
  }
  nodes_.reserve(2 * items.size());
  if (!items.empty()) build(boxes, items.begin(), items.end());
}

template <class Bounds>
void BoundsTree<Bounds>::build(const std::vector<Bounds>& boxes, Iterator begin, Iterator end) {
  const std::size_t self = nodes_.size();
  nodes_.push_back({{}, 0, *begin});
  Bounds all;
  for (Iterator it = begin; it != end; ++it) all.add(boxes[*it]);
  if (end - begin > 1) {
    int widest = 0;
    for (int axis = 1; axis < Bounds::axes; ++axis) {
      if (all.extent(axis) > all.extent(widest)) widest = axis;
    }
    const auto centre2 = [&](Index item) { return boxes[item].centre2(widest); };
    const Iterator half = begin + (end - begin) / 2;
    std::nth_element(begin, half, end, [&](Index a, Index b) { return centre2(a) < centre2(b); });
    build(boxes, begin, half);
    build(boxes, half, end);
  }
  nodes_[self].box = all;
  nodes_[self].end = static_cast<Index>(nodes_.size());
}

template class BoundsTree<Box>;
template class BoundsTree<MovingBox>;

}  // namespace collide::surface
