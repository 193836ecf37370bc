#pragma once
// The card of the first minute: the paper's method and an exact one on the same frame, what the former misses, and why.

#include "app/session/session.h"
#include "app/ui/widgets/widgets.h"

namespace app::ui {

class StoryCard {
 public:
  /// Draws what both methods find. The comparison must include the paper's method (CompareChoice::with_paper).
  void draw(Widgets& widgets, const Session& session);
  /// Draws what it costs in this scene, as far as it is known, and a sentence on what is missed, each behind a button
  /// that shows it. Must follow draw().
  void draw_sentence(Widgets& widgets, const Session& session) const;

 private:
  struct Miss {
    int frame;
    std::size_t missed, contacts;
    collide::Coverage coverage;
  };

  void follow(const Session& session);
  std::string sentence(const Session& session) const;

  std::uint64_t reports_ = 0, world_ = 0;
  std::optional<Miss> last_;  // in this world
};

}  // namespace app::ui
