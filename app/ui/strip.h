#pragma once
// The strip above the scene: the status lights, the card on what the paper's method misses, the legend of the overlays
// if there is no sidebar, messages, and the scene's sentence. It covers nothing of the scene.

#include "app/ui/layout.h"
#include "app/ui/widgets/widgets.h"

namespace app::ui {

class Strip {
 public:
  /// Draws the strip over the area that the layout gives it.
  void draw(Widgets& widgets, const Session& session, const UiState& ui, const Layout& layout);
  /// Returns the height that its contents had in the last draw(), in ImGui units. While the same parts are shown it
  /// only grows, so that the scene below does not jump with the length of texts.
  float height() const { return height_; }

 private:
  /// All that the height depends on but the length of texts.
  struct Parts {
    float width = 0;
    bool cards = false, lights = false, explained = false, story = false, sidebar = false, messages = false;
    render::Overlays legend;
    bool operator==(const Parts&) const = default;
  };

  static void draw_cards(Widgets& widgets, const Session& session, const UiState& ui, const Parts& parts);

  Parts parts_;
  float height_ = 0;
};

/// True if there is something to say that is shown even over nothing but the scene: what went wrong or was done, or
/// what is imported.
bool has_messages(const Session& session);

}  // namespace app::ui
