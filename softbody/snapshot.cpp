#include "softbody/snapshot.h"

#include <cassert>

#include "softbody/world_state.h"

namespace softbody {
namespace {

std::size_t bytes_of(const auto& list) { return list.size() * sizeof(list[0]); }

}  // namespace

std::size_t DynamicsState::bytes() const {
  std::size_t sum = bytes_of(batches) + bytes_of(bodies) + bytes_of(shield_pairs) + surface.bytes();
  for (const auto* components : {&x, &v})
    for (const auto& c : *components) sum += bytes_of(c);
  return sum;
}

DynamicsState Dynamics::save() const {
  DynamicsState state{batches_, bodies_, x_, v_, shield_.thickness, shield_.pairs, surface_.save(), held_rate_};
  for (Batch& b : state.batches) {  // for one frame only, and they point into the batch that they were copied from
    b.near_solids.clear();
    b.solid_features.clear();
  }
  return state;
}

void Dynamics::restore(const DynamicsState& state) {
  batches_ = state.batches;
  bodies_ = state.bodies;
  x_ = state.x;
  v_ = state.v;
  for (auto& c : f_) c.resize(x_[0].size());
  shield_.thickness = state.shield_thickness;
  shield_.pairs = state.shield_pairs;
  surface_.restore(state.surface);
  held_rate_ = state.held_rate;
  moving_.clear();
}

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
