// Dynamics: the detector's contacts become pairs of the shield, or the surfaces near each other rows of their contact.

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "softbody/contact/law.h"
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
  const Prototype& p = *batches_[body.batch].prototype;
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

glm::vec3 Dynamics::contact_normal(const ShieldPair& pair, Index vertex_a, Index vertex_b) const {
  const auto read = [&](std::size_t s) { return glm::vec3(x_[0][s], x_[1][s], x_[2][s]); };
  const glm::vec3 between = direction(read(pair.slot_a) - read(pair.slot_b) + pair.offset);
  const bool surfaces =
      pair.body_a != pair.body_b && prototype(pair.body_a).mesh.closed && prototype(pair.body_b).mesh.closed;
  if (!surfaces) return between;
  const glm::vec3 apart = vertex_normal(bodies_[pair.body_b], vertex_b) - vertex_normal(bodies_[pair.body_a], vertex_a);
  return glm::length(apart) > 0.5f ? glm::normalize(apart) : between;  // surfaces that face the same way tell nothing
}

/// contacts_of: as many zeros as vertices.
void Dynamics::find_pairs(const SeenContacts& seen, std::vector<std::uint32_t>& contacts_of,
                          std::vector<ShieldPair>& pairs) const {
  const auto& [vertices, vertex_body, contacts] = seen;
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
    const Material &ma = prototype(a).material, &mb = prototype(b).material;
    ShieldPair pair{.contact = c,
                    .slot_a = slot(bodies_[a], va),
                    .slot_b = slot(bodies_[b], vb),
                    .body_a = a,
                    .body_b = b,
                    .offset = glm::vec3(bodies_[a].origin - bodies_[b].origin),
                    .normal = {},
                    .stiffness = float(std::min(ma.contact_stiffness, mb.contact_stiffness) /
                                       double(std::max(contacts_of[c.a], contacts_of[c.b]))),
                    .friction = float(law::common_friction(ma.friction, mb.friction))};
    pair.normal = contact_normal(pair, va, vb);
    pairs.push_back(pair);
  }
}

void Dynamics::set_contacts(const SeenContacts& seen, float shield) {
  shield_.thickness = shield;
  pairs_before_.swap(shield_.pairs);
  shield_.pairs.clear();
  contacts_of_.assign(seen.vertex_body.size(), 0);
  find_pairs(seen, contacts_of_, shield_.pairs);
  shield_.inherit(pairs_before_);
  shield_.force.resize(shield_.pairs.size());
  shield_.group(batches_.size(), [&](BodyId body) { return bodies_[body].batch; });
}

std::vector<PairEnergy> Dynamics::shield_energies() const {
  Shield last = shield_;
  for (ShieldPair& p : last.pairs) p.offset = glm::vec3(bodies_[p.body_a].origin - bodies_[p.body_b].origin);
  return last.energies({x_[0].data(), x_[1].data(), x_[2].data()});
}

std::vector<PairEnergy> Dynamics::shield_energies(const SeenContacts& seen, float shield) const {
  Shield coming;
  coming.thickness = shield;
  std::vector<std::uint32_t> contacts_of(seen.vertex_body.size(), 0);
  find_pairs(seen, contacts_of, coming.pairs);
  coming.inherit(shield_.pairs);
  return coming.energies({x_[0].data(), x_[1].data(), x_[2].data()});
}

/// Wakes sleepers that a body comes near in the coming frame which is faster than twice the speed of sleep: who sleeps
/// through a hit stands like a wall.
void Dynamics::wake_what_is_hit(double seconds) {
  if (std::none_of(bodies_.begin(), bodies_.end(), [](const Body& b) { return b.moves(); })) return;
  if (std::none_of(bodies_.begin(), bodies_.end(), [](const Body& b) { return b.asleep; })) return;
  find_surface_contacts(seconds, seconds, 0);
  for (const collide::surface::SurfacePair& pair : surface_.search().pairs())
    for (const auto& [sleeper, by] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)}) {
      if (!bodies_[sleeper].asleep || !bodies_[by].moves() || fastest(by) <= 2 * scene_.sleep.speed) continue;
      put_to_sleep(sleeper, false);
      found_ = 0;  // its candidates are others now that it moves
    }
}

/// Of h seconds, that the candidates at hand may be taken for, if they hold: one at least.
int Dynamics::foreseen_substeps(double left, double h) const {
  const double seconds = double(surface_.search().predicted_until()) - (found_ - left);
  return std::max(1, int(std::min(seconds / h + 1e-3, 1e6)));
}

/// Finds the candidates of surface contact, unless those at hand hold: for the seconds `ahead` at least, of those that
/// are left of the frame; of those whose strain is fast, for the seconds `least` only.
void Dynamics::find_surface_contacts(double left, double ahead, double least) {
  const std::size_t n = vertices_->vertex_count();
  for (auto* components : {&seen_, &velocity_})
    for (auto& c : *components) c.resize(n);
  world_positions(seen_[0], seen_[1], seen_[2]);
  const collide::Frame now{seen_[0], seen_[1], seen_[2], vertices_};
  const auto elapsed = float(found_ - left);
  if (found_ > 0 && surface_.holds(now, elapsed, float(ahead))) return;
  for (BodyId id = 0; id < bodies_.size(); ++id)
    for (Index v = 0; v < vertices_->size(id); ++v)
      for (std::size_t k = 0; k < 3; ++k) velocity_[k][vertices_->first[id] + v] = v_[k][slot(bodies_[id], v)];
  const collide::surface::Motion motion{now, velocity_[0], velocity_[1], velocity_[2]};
  if (found_ > 0) {
    surface_.renew(motion, elapsed, float(ahead), crew_.workers());
    surface_work_ += double(surface_.search().work());
    return;
  }
  found_ = left;
  since_found_.assign(std::size_t(crew_.workers().threads()), 0.0f);
  std::vector<collide::surface::SurfaceBody> traits;
  std::vector<ContactBody> contacts;
  for (BodyId id = 0; id < bodies_.size(); ++id) {
    const Body& body = bodies_[id];
    const Prototype& p = prototype(id);
    const auto edge = float(p.mean_edge);
    const float reach = std::clamp(0.5f * float(p.material.thickness), 0.001f * edge, 0.1f * edge);
    traits.push_back({p.surface.get(), reach, 0, edge, body.moves()});
    contacts.push_back({body.origin, slot(body, 0), std::size_t(batches_[body.batch].width),
                        body.moves() ? float(1 / p.particle_mass) : 0.0f, float(p.material.friction),
                        float(p.material.restitution), &p.shape->rest()});
  }
  surface_.find(motion, std::move(traits), std::move(contacts),
                {float(left), float(least), self_contact_, max_work_.candidates(n)}, float(ahead), crew_.workers());
  surface_work_ += double(surface_.search().work());
}

}  // namespace softbody
