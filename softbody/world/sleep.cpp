#include "softbody/world/sleep.h"

#include <algorithm>
#include <limits>

#include "softbody/mesh/sets.h"

namespace softbody {
namespace {

/// Calls visit(a, b) for each pair of bodies that have contacts; contacts of the same two mostly follow each other.
void for_each_pair(std::span<const BodyId> vertex_body, const std::vector<collide::Contact>& contacts,
                   const auto& visit) {
  BodyId last_a = std::numeric_limits<BodyId>::max(), last_b = last_a;
  for (const collide::Contact& c : contacts) {
    const BodyId a = vertex_body[c.a], b = vertex_body[c.b];
    if (a == b || (a == last_a && b == last_b)) continue;
    last_a = a, last_b = b;
    visit(a, b);
  }
}

}  // namespace

void wake_touched(const SleepRule& rule, State& state, std::span<const BodyId> vertex_body,
                  const std::vector<collide::Contact>& contacts) {
  bool any = false;
  for (BodyId b = 0; b < state.body_count() && !any; ++b) any = state.body(b).asleep;
  if (!any) return;
  const auto wakes = [&](BodyId by, BodyId sleeper) {
    return state.body(sleeper).asleep && state.body(by).moves() && state.max_particle_speed(by) > 2 * rule.speed;
  };
  for_each_pair(vertex_body, contacts, [&](BodyId a, BodyId b) {
    if (wakes(a, b)) state.set_asleep(b, false);
    if (wakes(b, a)) state.set_asleep(a, false);
  });
}

void settle(const SleepRule& rule, State& state, std::span<const BodyId> vertex_body,
            const std::vector<collide::Contact>& contacts,
            const std::vector<collide::surface::ItemPair>& interactions) {
  const BodyId count = state.body_count();
  bool any = false;
  for (BodyId b = 0; b < count; ++b) {
    if (!state.body(b).moves()) continue;
    BodyMemory& memory = state.memory(b);
    memory.calm_frames = memory.speed < rule.speed ? memory.calm_frames + 1 : 0;
    any = any || memory.calm_frames >= rule.frames;
  }
  if (!any) return;     // most frames need no islands
  Sets islands(count);  // of moving bodies that touch
  const auto join = [&](BodyId a, BodyId b) {
    if (a != b && state.body(a).moves() && state.body(b).moves()) islands.unite(a, b);
  };
  for_each_pair(vertex_body, contacts, join);
  for (const collide::surface::ItemPair& pair : interactions) join(pair.a, pair.b);
  std::vector<int> calm(count, std::numeric_limits<int>::max());  // of each island: the calm frames of its latest body
  for (BodyId b = 0; b < count; ++b)
    if (state.body(b).moves())
      calm[islands.find(b)] = std::min(calm[islands.find(b)], state.body(b).memory.calm_frames);
  for (BodyId b = 0; b < count; ++b)
    if (state.body(b).moves() && calm[islands.find(b)] >= rule.frames) state.set_asleep(b, true);
}

}  // namespace softbody
