#pragma once
// Cuts points into patches.

#include "collide/trees/tree_search.h"

namespace collide::trees {

/// Brings items into the order of their patches of patch_size items, and of groups of patch_size patches: cuts across
/// the longest side, near the median, so that all patches and groups but the last are full.
void cut_into_patches(std::span<Item> items);

}  // namespace collide::trees
