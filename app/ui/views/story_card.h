#pragma once
// The card of the first minute: the paper's method and an exact one on the same frame, what the former misses, and why.

#include "app/session/session.h"
#include "app/ui/widgets/floating_box.h"

namespace app::ui {

class StoryCard {
 public:
  /// Draws the card in the upper right corner of `area`. Returns the lower end (y) of a card that stands in its place,
  /// else the upper end of the area. The comparison must include the paper's method (CompareChoice::with_paper).
  float draw(Widgets& widgets, const Session& session, const ScreenRect& area);

 private:
  struct Miss {
    int frame;
    std::size_t missed, contacts;
    collide::Coverage coverage;
  };

  void follow(const Session& session);
  std::string sentence(const Session& session) const;

  FloatingBox box_;
  std::uint64_t reports_ = 0, world_ = 0;
  std::optional<Miss> last_;  // in this world
};

}  // namespace app::ui
