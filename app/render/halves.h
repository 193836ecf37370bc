#pragma once
// Two worlds side by side in one picture.

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/render/renderer.h"

namespace app::render {

inline constexpr float min_half = 0.15f;  // of the picture's width

/// Returns the left and the right part of a viewport. The line between them lies at this share of the width.
inline std::array<engine::Viewport, 2> side_by_side(const engine::Viewport& whole, float line) {
  const int left =
      static_cast<int>(std::lround(std::clamp(line, min_half, 1 - min_half) * static_cast<float>(whole.size.x)));
  return {{{whole.origin, {left, whole.size.y}},
           {{whole.origin.x + left, whole.origin.y}, {whole.size.x - left, whole.size.y}}}};
}

}  // namespace app::render
