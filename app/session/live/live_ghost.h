#pragma once
// The ghost of the world that is shown, if the user wants one, kept in step with it.

#include <memory>
#include <string>

#include "app/base/time_series.h"
#include "app/session/live/ghost.h"

namespace app::session {

/// Functions return what went wrong, for the user; the ghost is gone then. Empty: nothing did.
class LiveGhost {
 public:
  /// Begins a ghost of the present state, or ends it. On an error the ghost before stays.
  [[nodiscard]] std::string choose(const softbody::World& world,
                                   const std::optional<softbody::IntegratorChoice>& choice, int threads);
  /// The world was changed: the ghost begins anew from its present state, or ends if there is none (nullptr).
  [[nodiscard]] std::string restart(const softbody::World* world);
  /// Follows a step of the world.
  [[nodiscard]] std::string step(const softbody::World& world);

  /// nullptr if there is none.
  const Ghost* get() const { return ghost_.get(); }
  /// How long (ms) its last step took.
  double step_ms() const { return ghost_ ? ghost_->world().last_step().total_ms : 0; }
  /// The distance of the ghost from the world, by frame.
  const TimeSeries& distances() const { return distances_; }
  /// Changes whenever the ghost may be elsewhere or another.
  std::uint64_t revision() const { return revision_; }

 private:
  std::unique_ptr<Ghost> ghost_;
  TimeSeries distances_;
  std::uint64_t revision_ = 0;
};

}  // namespace app::session
