// The k-d tree and the octree: a tree over all vertices, built anew in every frame and compared with itself. Each says
// how a node, which has been shrunk to the box of its vertices, is cut.

#include <algorithm>

#include "collide/core/body_boxes.h"
#include "collide/core/cutoff.h"
#include "collide/methods/detectors.h"
#include "collide/trees/point_tree.h"

namespace collide::methods {

namespace {

using trees::Item;

class VertexTree final : public Detector {
 public:
  explicit VertexTree(trees::Cut cut) : cut_(cut) {}

  void detect(const Frame& frame, const Settings& settings, Workers& workers, Result& result) override {
    bodies_.build(frame, result);
    tree_.build(frame, bodies_.live, cut_, leaf_size, workers);
    constexpr double test_ns = 50;  // of work, of a vertex
    search_.begin(frame, settings, tree_.points(), workers.threads_for(test_ns * tree_.points().size()));
    tree_search_.run(tree_.nodes(), settings.self_collision, contact_cutoff(settings.tolerance), search_, workers);
    search_.finish(result);
  }

 private:
  static constexpr Index leaf_size = 24;  // vertices
  trees::Cut cut_;
  BodyBoxes bodies_;
  trees::PointTree tree_;
  trees::TreeSearch tree_search_;
  ContactSearch search_;
};

/// Returns the median of a sample of the items along an axis.
float sampled_median(std::span<const Item> items, std::size_t axis) {
  constexpr std::size_t max_sample = 31;
  std::array<float, max_sample> sample;
  const std::size_t count = std::clamp<std::size_t>(items.size() / 16, 5, max_sample);
  for (std::size_t k = 0; k < count; ++k) sample[k] = items[(2 * k + 1) * items.size() / (2 * count)].at[axis];
  const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(sample.begin(), middle, sample.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

/// Copies the items below a value to the front, and the others to the back. Returns how many are below.
std::size_t divide(std::span<const Item> items, std::size_t axis, float value, Item* to) {
  std::size_t low = 0, high = items.size();
  for (const Item& item : items) {  // to both places, of which one stays: no mispredicted branches
    to[low] = to[high - 1] = item;
    const bool below = item.at[axis] < value;
    low += below;
    high -= !below;
  }
  return low;
}

/// Cuts a node of the k-d tree across its longest side, near the median.
trees::Parts halve(std::span<const Item> items, const Aabb& box, Item* to) {
  const int side = longest_axis(box.hi - box.lo);
  if (!(box.hi[side] > box.lo[side])) return {};
  const auto axis = static_cast<std::size_t>(side);
  std::size_t low = divide(items, axis, sampled_median(items, axis), to);
  if (std::min(low, items.size() - low) < items.size() / 8) {  // the sample is poor: cut at the true median
    low = items.size() / 2;
    std::copy(items.begin(), items.end(), to);
    trees::part_at({to, items.size()}, low, axis);
  }
  trees::Parts parts;
  parts.size = {static_cast<Index>(low), static_cast<Index>(items.size() - low)};
  parts.count = 2;
  return parts;
}

/// Where the sides of a node are cut: values above `middle` belong to the upper half.
struct Middles {
  std::array<float, 3> middle;

  explicit Middles(const Aabb& box) {
    const glm::vec3 half = box.hi * 0.5f - box.lo * 0.5f;
    const float longest = std::max({half.x, half.y, half.z});
    for (int axis = 0; axis < 3; ++axis) {
      const float lo = box.lo[axis], hi = box.hi[axis], mid = lo * 0.5f + hi * 0.5f;
      const bool whole = half[axis] < longest / 2;
      middle[static_cast<std::size_t>(axis)] = whole ? hi : mid < hi ? mid : lo;  // neither half of two floats is empty
    }
  }

  std::size_t octant(const Item& item) const {
    return std::size_t{item.at[0] > middle[0]} | std::size_t{item.at[1] > middle[1]} << 1 |
           std::size_t{item.at[2] > middle[2]} << 2;
  }
};

/// Cuts a node of the octree across the middle of its sides, by a counting sort by octant. Sides shorter than half of
/// the longest one stay whole, so that nodes become cubes.
trees::Parts cut_into_octants(std::span<const Item> items, const Aabb& box, Item* to) {
  const Middles middles(box);
  std::array<Index, 8> size{}, next{};
  for (const Item& item : items) ++size[middles.octant(item)];
  trees::Parts parts;
  Index end = 0;
  for (std::size_t octant = 0; octant < size.size(); ++octant) {
    next[octant] = end;
    end += size[octant];
    if (size[octant] > 0) parts.size[parts.count++] = size[octant];
  }
  if (parts.count == 1) return {};  // all in one place
  for (const Item& item : items) to[next[middles.octant(item)]++] = item;
  return parts;
}

}  // namespace

std::unique_ptr<Detector> make_kd_tree() { return std::make_unique<VertexTree>(halve); }
std::unique_ptr<Detector> make_octree() { return std::make_unique<VertexTree>(cut_into_octants); }

}  // namespace collide::methods
