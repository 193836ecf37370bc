#pragma once
// The card of the first minute: the paper's method and an exact one on the same frame, what the former misses, and why.

#include "app/session/session.h"
#include "app/ui/widgets/floating_box.h"

namespace app::ui {

class StoryCard {
 public:
  enum class Action { none, close, explain };

  /// Draws the card in a right corner of `area`; in a low area only its figures. Returns what the user clicked. The
  /// comparison must look for what the paper's method misses (CompareChoice::shows_misses).
  Action draw(Widgets& widgets, const Session& session, const ScreenRect& area, bool at_bottom);

 private:
  struct Miss {
    int frame;
    std::size_t missed, contacts;
  };

  void follow(const Session& session);
  std::string sentence(const Session& session) const;
  Action draw_why(Widgets& widgets, const Session& session) const;

  FloatingBox box_;
  std::uint64_t reports_ = 0, world_ = 0;
  std::optional<Miss> last_;  // in this world
};

}  // namespace app::ui
