#pragma once
// Puts bodies at rest to sleep. Islands of touching bodies fall asleep together, so that no sleeper loses its support.

#include "collide/methods.h"
#include "softbody/contact/surface_candidates.h"
#include "softbody/scene/scene.h"
#include "softbody/state/state.h"

namespace softbody {

/// Wakes sleepers that are touched by a body faster than twice the rule's speed. Call it before the frame's substeps.
void wake_touched(const SleepRule& rule, State& state, std::span<const BodyId> vertex_body,
                  const std::vector<collide::Contact>& contacts);
/// Counts calm frames, and puts islands to sleep whose bodies have all been calm for long enough. Bodies touch if they
/// have one of these contacts or, with surface contact, are a pair of `interactions`. Call it after detection; the
/// speeds are those of BodyMemory.
void settle(const SleepRule& rule, State& state, std::span<const BodyId> vertex_body,
            const std::vector<collide::Contact>& contacts, const std::vector<collide::surface::ItemPair>& interactions);

}  // namespace softbody
