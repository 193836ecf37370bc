// Dynamics: the detector's contacts become penalty pairs, or the surfaces near each other rows of their contact.

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "softbody/contact/keys.h"
#include "softbody/contact/law.h"
#include "softbody/forces/penalty_contact.h"
#include "softbody/integrate/dynamics.h"

namespace softbody {
namespace {

/// The unit vector along v, or up if v has no length.
glm::vec3 direction(const glm::vec3& v) {
  const float length = glm::length(v);
  return length > 0 ? v / length : glm::vec3(0, 1, 0);
}

}  // namespace

glm::vec3 Dynamics::vertex_normal(const Body& body, Index vertex) const {
  const BodyModel& p = *batches_[body.batch].model;
  const auto read = [&](Index i) {
    const std::size_t s = slot(body, i);
    return glm::vec3(x_[0][s], x_[1][s], x_[2][s]);
  };
  glm::vec3 sum(0.0f);  // of the faces' normals times twice their areas
  for (const Index face : p.faces_of(vertex)) {
    const auto& [a, b, c] = p.mesh.triangles[face];
    const glm::vec3 corner = read(a);
    sum += glm::cross(read(b) - corner, read(c) - corner);
  }
  return direction(sum);
}

glm::vec3 Dynamics::contact_normal(const PenaltyPair& pair, Index vertex_a, Index vertex_b) const {
  const auto read = [&](std::size_t s) { return glm::vec3(x_[0][s], x_[1][s], x_[2][s]); };
  const glm::vec3 between = direction(read(pair.slot_a) - read(pair.slot_b) + pair.offset);
  const bool surfaces = pair.body_a != pair.body_b && model(pair.body_a).mesh.closed && model(pair.body_b).mesh.closed;
  if (!surfaces) return between;
  const glm::vec3 apart = vertex_normal(bodies_[pair.body_b], vertex_b) - vertex_normal(bodies_[pair.body_a], vertex_a);
  return glm::length(apart) > 0.5f ? glm::normalize(apart) : between;  // surfaces that face the same way tell nothing
}

/// contacts_of: as many zeros as vertices.
void Dynamics::find_pairs(const DetectedContacts& detected, std::vector<std::uint32_t>& contacts_of,
                          std::vector<PenaltyPair>& pairs) const {
  const auto& [vertices, vertex_body, contacts] = detected;
  const auto still = [this, bodies = vertex_body](const collide::Contact& c) {
    return !bodies_[bodies[c.a]].moves() && !bodies_[bodies[c.b]].moves();
  };
  for (const collide::Contact& c : contacts) {
    if (still(c)) continue;
    ++contacts_of[c.a];
    ++contacts_of[c.b];
  }
  for (const collide::Contact& c : contacts) {
    if (still(c)) continue;
    const BodyId a = vertex_body[c.a], b = vertex_body[c.b];
    const Index va = c.a - vertices.first[a], vb = c.b - vertices.first[b];
    const Material &ma = model(a).material, &mb = model(b).material;
    PenaltyPair pair{.contact = c,
                     .slot_a = slot(bodies_[a], va),
                     .slot_b = slot(bodies_[b], vb),
                     .body_a = a,
                     .body_b = b,
                     .offset = glm::vec3(bodies_[a].origin - bodies_[b].origin),
                     .normal = {},
                     .stiffness = float(std::min(ma[PenaltyContact::stiffness], mb[PenaltyContact::stiffness]) /
                                        double(std::max(contacts_of[c.a], contacts_of[c.b]))),
                     .friction = float(law::common_friction(ma[contact::friction], mb[contact::friction]))};
    pair.normal = contact_normal(pair, va, vb);
    pairs.push_back(pair);
  }
}

void Dynamics::set_contacts(const DetectedContacts& detected, float thickness) {
  penalty_.thickness = thickness;
  pairs_before_.swap(penalty_.pairs);
  penalty_.pairs.clear();
  contacts_of_.assign(detected.vertex_body.size(), 0);
  find_pairs(detected, contacts_of_, penalty_.pairs);
  penalty_.carry_over(pairs_before_);
  penalty_.force.resize(penalty_.pairs.size());
  penalty_.group(batches_.size(), [&](BodyId body) { return bodies_[body].batch; });
}

std::vector<PairEnergy> Dynamics::penalty_energies() const {
  PenaltyContact last = penalty_;
  for (PenaltyPair& p : last.pairs) p.offset = glm::vec3(bodies_[p.body_a].origin - bodies_[p.body_b].origin);
  return last.energies({x_[0].data(), x_[1].data(), x_[2].data()});
}

std::vector<PairEnergy> Dynamics::penalty_energies(const DetectedContacts& detected, float thickness) const {
  PenaltyContact coming;
  coming.thickness = thickness;
  std::vector<std::uint32_t> contacts_of(detected.vertex_body.size(), 0);
  find_pairs(detected, contacts_of, coming.pairs);
  coming.carry_over(penalty_.pairs);
  return coming.energies({x_[0].data(), x_[1].data(), x_[2].data()});
}

/// Wakes sleepers that a body comes near in the coming frame which is faster than twice the speed of sleep: who sleeps
/// through a hit stands like a wall.
void Dynamics::wake_hit_sleepers(double seconds) {
  if (std::none_of(bodies_.begin(), bodies_.end(), [](const Body& b) { return b.moves(); })) return;
  if (std::none_of(bodies_.begin(), bodies_.end(), [](const Body& b) { return b.asleep; })) return;
  find_surface_contacts(seconds, seconds, 0);
  for (const collide::surface::SurfacePair& pair : surface_.search().pairs())
    for (const auto& [sleeper, by] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)}) {
      if (!bodies_[sleeper].asleep || !bodies_[by].moves() || max_particle_speed(by) <= 2 * scene_.sleep.speed)
        continue;
      set_asleep(sleeper, false);
      found_ = 0;  // its candidates are others now that it moves
    }
}

/// Of h seconds, that the candidates at hand may be taken for, if they hold: one at least.
int Dynamics::predicted_substeps(double left, double h) const {
  const double seconds = double(surface_.search().predicted_until()) - (found_ - left);
  return std::max(1, int(std::min(seconds / h + 1e-3, 1e6)));
}

/// Finds the candidates of surface contact, unless those at hand hold: for the seconds `ahead` at least, of those that
/// are left of the frame; of those whose strain is fast, for the seconds `least` only.
void Dynamics::find_surface_contacts(double left, double ahead, double least) {
  const std::size_t n = vertices_->vertex_count();
  for (auto* components : {&world_positions_, &velocity_})
    for (auto& c : *components) c.resize(n);
  world_positions(world_positions_[0], world_positions_[1], world_positions_[2]);
  const collide::Frame now{world_positions_[0], world_positions_[1], world_positions_[2], vertices_};
  const auto elapsed = float(found_ - left);
  if (found_ > 0 && surface_.check_valid(now, elapsed, float(ahead))) return;
  for (BodyId id = 0; id < bodies_.size(); ++id)
    for (Index v = 0; v < vertices_->size(id); ++v)
      for (std::size_t k = 0; k < 3; ++k) velocity_[k][vertices_->first[id] + v] = v_[k][slot(bodies_[id], v)];
  const collide::surface::Motion motion{now, velocity_[0], velocity_[1], velocity_[2]};
  if (found_ > 0) {
    surface_.update(motion, elapsed, float(ahead), crew_.workers());
    surface_work_ += double(surface_.search().work());
    return;
  }
  found_ = left;
  since_found_.assign(std::size_t(crew_.workers().threads()), 0.0f);
  std::vector<collide::surface::SurfaceBody> traits;
  std::vector<ContactBody> contacts;
  for (BodyId id = 0; id < bodies_.size(); ++id) {
    const Body& body = bodies_[id];
    const BodyModel& p = model(id);
    const auto edge = float(p.mean_edge);
    const float margin = std::clamp(0.5f * float(p.material[Material::thickness]), 0.001f * edge, 0.1f * edge);
    traits.push_back({p.surface.get(), margin, 0, edge, body.moves()});
    contacts.push_back({body.origin, slot(body, 0), std::size_t(batches_[body.batch].width),
                        body.moves() ? float(1 / p.particle_mass) : 0.0f, float(p.material[contact::friction]),
                        float(p.material[contact::restitution]), &p.shape->rest()});
  }
  surface_.find(motion, std::move(traits), std::move(contacts),
                {float(left), float(least), self_contact_, max_work_.candidates(n)}, float(ahead), crew_.workers());
  surface_work_ += double(surface_.search().work());
}

}  // namespace softbody
