#include "softbody/world/snapshot.h"

#include <cassert>

#include "softbody/world/world_state.h"

namespace softbody {

std::size_t Snapshot::bytes() const {
  const Insides& all = *insides;
  return sizeof(*this) + sizeof(all) + bytes_of(all.scene.bodies) + bytes_of(all.arrived) + bytes_of(all.added) +
         all.dynamics.bytes();
}

Snapshot World::snapshot() const {
  const State& s = *state_;
  return {.frame = s.frame,
          .grab = grabbed(),
          .insides = std::make_shared<const Snapshot::Insides>(Snapshot::Insides{.scene = s.scene,
                                                                                 .prototypes = s.prototypes,
                                                                                 .dynamics = s.dynamics.save(),
                                                                                 .arrived = s.arrived,
                                                                                 .visitors = s.visitors,
                                                                                 .added = s.added,
                                                                                 .drops = s.drops,
                                                                                 .drop_direction = s.drop_direction,
                                                                                 .integrator = s.options.integrator,
                                                                                 .method = s.method,
                                                                                 .settings = s.settings,
                                                                                 .shield = s.shield,
                                                                                 .report = s.report})};
}

void World::restore(const Snapshot& snapshot) {
  assert(snapshot.insides);
  State& s = *state_;
  const Snapshot::Insides& from = *snapshot.insides;
  s.scene = from.scene;
  s.prototypes = from.prototypes;
  s.visitors = from.visitors;
  s.added = from.added;
  s.sleep = Sleep(s.scene.sleep);
  s.options.integrator = from.integrator;
  s.report = from.report;
  s.replan();
  s.set_integrator();  // unchecked: what it has come to since would not be accepted from a scene any more
  s.dynamics.restore(from.dynamics);
  s.dynamics.grab(snapshot.grab);
  s.arrived = from.arrived;
  s.drops = from.drops;
  s.drop_direction = from.drop_direction;
  s.frame = snapshot.frame;
  s.settings = from.settings;
  s.shield = from.shield;
  s.method = from.method;
  s.detector = s.method->make();  // what it remembers is of another state
  s.count_vertices();
  s.gather();
  s.detect();
}

/// Bodies and their vertices, as the dynamics have them.
void World::State::count_vertices() {
  bodies = {};
  vertex_body.clear();
  for (BodyId id = 0; id < dynamics.body_count(); ++id) {
    bodies.add(dynamics.prototype(id).shape);
    vertex_body.resize(bodies.vertex_count(), id);
  }
}

}  // namespace softbody
