#include "softbody/world/snapshot.h"

#include <cassert>

#include "softbody/world/world_parts.h"

namespace softbody {

std::size_t Snapshot::bytes() const {
  const Values& all = *values;
  return sizeof(*this) + sizeof(all) + bytes_of(all.scene.bodies) + bytes_of(all.arrived) + bytes_of(all.added) +
         all.solver.bytes();
}

Snapshot World::snapshot() const {
  const Parts& s = *parts_;
  return {.frame = s.frame,
          .grab = grabbed(),
          .values = std::make_shared<const Snapshot::Values>(Snapshot::Values{.scene = s.scene,
                                                                              .models = s.models,
                                                                              .solver = s.solver.save(),
                                                                              .arrived = s.arrived,
                                                                              .added_bodies = s.added_bodies,
                                                                              .added = s.added,
                                                                              .drops = s.drops,
                                                                              .drop_direction = s.drop_direction,
                                                                              .integrator = s.options.integrator,
                                                                              .method = s.method,
                                                                              .settings = s.settings,
                                                                              .penalty_thickness = s.penalty_thickness,
                                                                              .report = s.report})};
}

void World::restore(const Snapshot& snapshot) {
  assert(snapshot.values);
  Parts& s = *parts_;
  const Snapshot::Values& from = *snapshot.values;
  s.scene = from.scene;
  s.models = from.models;
  s.added_bodies = from.added_bodies;
  s.added = from.added;
  s.sleep = Sleep(s.scene.sleep);
  s.options.integrator = from.integrator;
  s.report = from.report;
  s.update_plan();
  s.set_integrator();  // without a check: the state may be one that a new scene would be refused for
  s.solver.restore(from.solver);
  s.solver.hand().take(snapshot.grab);
  s.arrived = from.arrived;
  s.drops = from.drops;
  s.drop_direction = from.drop_direction;
  s.frame = snapshot.frame;
  s.settings = from.settings;
  s.penalty_thickness = from.penalty_thickness;
  s.method = from.method;
  s.detector = s.method->make();  // a new one: the old one caches another state
  s.count_vertices();
  s.update_positions();
  s.detect();
}

/// Counts bodies and their vertices anew from the solver's state.
void World::Parts::count_vertices() {
  bodies = {};
  vertex_body.clear();
  for (BodyId id = 0; id < solver.state().body_count(); ++id) {
    bodies.add(solver.state().model(id).shape);
    vertex_body.resize(bodies.vertex_count(), id);
  }
}

}  // namespace softbody
