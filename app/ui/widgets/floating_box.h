#pragma once
// A box over the scene that the user can move within the scene.

#include <optional>

#include "app/ui/widgets/dock.h"

namespace app::ui {

inline constexpr float box_width = 430;  // of boxes over the scene, design pixels

class FloatingBox {
 public:
  /// `at_right`: where the box stands until the user moves it, at the right or at the left end of the area.
  /// `at_bottom`: at the lower or at the upper end.
  void begin(Widgets& widgets, const char* name, const ScreenRect& area, float width, bool at_right, bool at_bottom);
  /// Must follow begin(). Returns the rectangle that the box covers.
  ScreenRect end();
  /// False once the user has moved the box.
  bool in_its_place() const { return !moved_to_; }

 private:
  ScreenRect last_{};               // in the last frame
  std::optional<ImVec2> moved_to_;  // by the user, from the area's upper left corner
};

}  // namespace app::ui
