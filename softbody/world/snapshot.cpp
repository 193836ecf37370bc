#include "softbody/world/snapshot.h"

#include <cassert>

#include "softbody/world/world_parts.h"

namespace softbody {

std::size_t Snapshot::bytes() const {
  const Values& all = *values;
  return sizeof(*this) + sizeof(all) + bytes_of(all.world.scene.bodies) + bytes_of(all.world.arrived) +
         bytes_of(all.world.added) + all.solver.bytes();
}

Snapshot World::snapshot() const {
  const Parts& s = *parts_;
  return {.frame = s.frame,
          .grab = grabbed(),
          .values = std::make_shared<const Snapshot::Values>(Snapshot::Values{s, s.solver.save()})};
}

void World::restore(const Snapshot& snapshot) {
  assert(snapshot.values);
  Parts& s = *parts_;
  static_cast<WorldValues&>(s) = snapshot.values->world;
  s.settings = s.settings_of(s.scene);
  s.update_plan();
  s.set_integrator();  // without a check: the state may be one that a new scene would be refused for
  s.solver.restore(snapshot.values->solver);
  s.solver.hand().take(snapshot.grab);
  s.particles.detector = s.method().make();  // a new one: the old one caches another state
  s.count_vertices();
  s.update_positions();
  s.detect();
}

}  // namespace softbody
