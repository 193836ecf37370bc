#include "collide/trees/patch_cut.h"

#include <utility>

namespace collide::trees {
namespace {

/// Brings the items below the one that belongs to the place `middle` along the axis before it, and the others behind.
/// As std::nth_element(), but with a pivot from a sample, and without a branch that nobody can predict.
void split_at(std::span<Item> items, std::size_t middle, std::size_t axis) {
  constexpr std::size_t few = 14;
  for (int left = 40; items.size() > few && left > 0; --left) {  // so that bad samples cost no square
    const auto sample = [&](std::size_t k) { return items[items.size() * k / 6].at[axis]; };
    const auto [low_pair, high_pair] = std::pair(std::min(sample(1), sample(3)), std::max(sample(1), sample(3)));
    const std::array sorted{std::min(low_pair, sample(5)), std::max(low_pair, std::min(high_pair, sample(5))),
                            std::max(high_pair, sample(5))};
    const float pivot = sorted[middle * sorted.size() / items.size()];
    const auto part = [&](const auto& is_low) {
      Item* low = items.data();
      for (Item& item : items) {
        const Item moved = item;
        item = *low;
        *low = moved;
        low += is_low(moved.at[axis]);
      }
      return static_cast<std::size_t>(low - items.data());
    };
    std::size_t low = part([pivot](float at) { return at < pivot; });
    if (low == 0) {  // the pivot is the least: bring all that are equal before the others
      low = part([pivot](float at) { return at <= pivot; });
      if (middle < low) return;
    }
    if (middle < low) {
      items = items.first(low);
    } else {
      items = items.subspan(low);
      middle -= low;
    }
  }
  part_at(items, middle, axis);
}

}  // namespace

void cut_into_patches(std::span<Item> items) {
  if (items.size() <= patch_size) return;
  constexpr std::size_t group_size = std::size_t{patch_size} * patch_size;
  const std::size_t unit = items.size() > group_size ? group_size : patch_size;
  const std::size_t low = (items.size() / 2 + unit - 1) / unit * unit;
  const Aabb box = bounds_of(items);
  split_at(items, low, static_cast<std::size_t>(longest_axis(box.hi * 0.5f - box.lo * 0.5f)));
  cut_into_patches(items.first(low));
  cut_into_patches(items.subspan(low));
}

}  // namespace collide::trees
