#pragma once
// A box over the scene that the user can move within the scene.

#include <optional>

#include "app/ui/widgets/dock.h"

namespace app::ui {

// Boxes over the scene, in design pixels.
inline constexpr float min_box_width = 310, max_box_width = 430, box_margin = 12;

/// Returns the width of boxes over `area`: two stand side by side if they fit.
float box_width(const Widgets& widgets, const ScreenRect& area);

class FloatingBox {
 public:
  /// Begins a window of this width. `at_right`: until the user moves it, it stands in the upper right corner of the
  /// area, else in the upper left.
  void begin(Widgets& widgets, const char* name, const ScreenRect& area, float width, bool at_right);
  /// Must follow begin(). Returns the lower end (y) of a box that stands in its place, else the upper end of the area.
  float end(const ScreenRect& area);

 private:
  ScreenRect last_{};               // in the last frame
  std::optional<ImVec2> moved_to_;  // by the user, from the area's upper left corner
};

}  // namespace app::ui
