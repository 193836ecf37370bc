#pragma once
// Rings round missed contacts, so that a single one is found in a heap.

#include <span>
#include <vector>

#include "app/render/drawn_positions.h"
#include "app/render/highlight.h"
#include "softbody/world/bodies_in_motion.h"

namespace app::render {

inline constexpr std::size_t max_miss_marks = 200;  // more would cover the scene

/// Returns a label with a ring for each group of missed contacts: those of the same two bodies that are near each
/// other. Larger groups come first; those beyond max_miss_marks are left out. `missed`: vertices of the world;
/// `positions`: those that are drawn.
std::vector<SceneLabel> miss_marks(const softbody::BodiesInMotion& world, std::span<const collide::Contact> missed,
                                   const DrawnPositions& positions);

}  // namespace app::render
