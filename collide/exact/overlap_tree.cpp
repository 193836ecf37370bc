#include "collide/exact/overlap_tree.h"

#include <algorithm>

#include "collide/core/aabb.h"

namespace collide::exact {

namespace {

Aabb bounds_of(const VertexSet& set) {
  return box_around(0, set.size, [&](std::size_t k) { return glm::vec3(set.x[k], set.y[k], set.z[k]); });
}

/// Copies the vertices k of a set for which keep(k) is true.
template <class Keep>
void filter(const VertexSet& set, VertexSet& kept, const Keep& keep) {
  kept.reserve(set.size);
  kept.size = 0;
  for (Index k = 0; k < set.size; ++k) {
    if (keep(k)) kept.add(set.x[k], set.y[k], set.z[k], set.vertex[k]);
  }
  kept.end();
}

/// Copies the vertices within the cutoff of a box. Never loses a contact: subtraction rounds monotonically.
void filter_near(const VertexSet& set, const Aabb& box, float cutoff, VertexSet& kept) {
  filter(set, kept, [&](Index k) {
    const glm::vec3 p(set.x[k], set.y[k], set.z[k]);
    return near({p, p}, box, cutoff);
  });
}

const std::vector<float>& along(const VertexSet& set, int axis) {
  return axis == 0 ? set.x : axis == 1 ? set.y : set.z;
}

}  // namespace

void OverlapTree::begin(int levels, float cutoff, float tolerance2, std::size_t max_contacts) {
  max_contacts_ = max_contacts;
  levels_ = levels;
  cutoff_ = cutoff;
  tolerance2_ = tolerance2;
  leaves_.clear();
  pair_tests_ = 0;
}

void OverlapTree::between(const VertexSet& a, const VertexSet& b, Index body, std::vector<Contact>& contacts) {
  body_ = body;
  contacts_ = &contacts;
  cut_between(a, b, 0);
}

void OverlapTree::cut_between(const VertexSet& a, const VertexSet& b, int depth) {
  const std::uint64_t tests = std::uint64_t{a.size} * b.size;
  if (is_leaf(tests, depth)) {
    if (tests == 0) return;
    pair_tests_ += tests;
    if (depth > 0) leaves_.push_back({bounds_of(a).lo, bounds_of(a).hi, body_});
    contacts_between(a, b, tolerance2_, max_contacts_, words_, *contacts_);
    return;
  }
  Level& own = level_[static_cast<std::size_t>(depth)];
  filter_near(a, bounds_of(b), cutoff_, own.near_a);
  if (own.near_a.size == 0) return;
  filter_near(b, bounds_of(own.near_a), cutoff_, own.near_b);
  const MidpointCut cut = cut_of(bounds_of(own.near_a));
  const int axis = cut.axis;
  const float mid = cut.mid;
  const std::vector<float>&va = along(own.near_a, axis), &vb = along(own.near_b, axis);
  filter(own.near_a, own.low_a, [&](Index k) { return va[k] < mid; });
  filter(own.near_b, own.low_b, [&](Index k) { return vb[k] - mid <= cutoff_; });
  filter(own.near_a, own.up_a, [&](Index k) { return va[k] >= mid; });
  filter(own.near_b, own.up_b, [&](Index k) { return mid - vb[k] <= cutoff_; });
  cut_between(own.low_a, own.low_b, depth + 1);
  cut_between(own.up_a, own.up_b, depth + 1);
}

}  // namespace collide::exact
