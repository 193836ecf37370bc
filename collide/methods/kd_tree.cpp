// A k-d tree over all vertices, built anew in every frame: each node is cut across its longest side, near the median.

#include <algorithm>

#include "collide/methods/detectors.h"
#include "collide/methods/vertex_tree.h"

namespace collide::methods {

namespace {

using trees::Item;

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

}  // namespace

std::unique_ptr<Detector> make_kd_tree() { return std::make_unique<VertexTree>(halve); }

}  // namespace collide::methods
