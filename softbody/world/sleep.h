#pragma once
// Bodies that have come to rest are put to sleep: islands of touching bodies together, so that no sleeper loses its
// support.

#include "softbody/integrate/dynamics.h"

namespace softbody {

class Sleep {
 public:
  explicit Sleep(SleepRule rule) : rule_(rule) {}

  /// Wakes sleepers that a body faster than twice the rule's speed touches. Call before the response.
  void wake_touched(Dynamics& dynamics, std::span<const BodyId> vertex_body,
                    const std::vector<collide::Contact>& contacts) const;
  /// Counts calm frames and puts islands to sleep whose bodies have all been calm for long enough. They touch by these
  /// contacts or, in surface contact, where their surfaces may. Call after detection.
  void settle(Dynamics& dynamics, std::span<const BodyId> vertex_body, const std::vector<collide::Contact>& contacts);

 private:
  BodyId root(BodyId body);

  SleepRule rule_;
  std::vector<BodyId> parent_;  // union-find over touching bodies that move
};

}  // namespace softbody
