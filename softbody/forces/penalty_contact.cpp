#include "softbody/forces/penalty_contact.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

#include "softbody/contact/keys.h"
#include "softbody/forces/penalty_law.h"

namespace softbody {
namespace {

/// Returns the unit vector along v, or up if v has no length.
glm::vec3 direction(const glm::vec3& v) {
  const float length = glm::length(v);
  return length > 0 ? v / length : glm::vec3(0, 1, 0);
}

glm::vec3 vertex_normal(const State& state, BodyId body, Index vertex) {
  const BodyModel& p = state.model(body);
  const auto place = [&](Index i) { return read(field(state.x), state.slot(body, i)); };
  glm::vec3 sum(0.0f);  // of the faces' normals times twice their areas
  for (const Index face : p.faces_of(vertex)) {
    const auto& [a, b, c] = p.mesh.triangles[face];
    const glm::vec3 corner = place(a);
    sum += glm::cross(place(b) - corner, place(c) - corner);
  }
  return direction(sum);
}

/// Returns the way from b to a, in m.
glm::vec3 between(const PenaltyPair& p, Field<const float> x) {
  return read(x, p.slot_a) - read(x, p.slot_b) + p.offset;
}

/// How the two particles of a pair stand and move.
struct Meeting {
  Meeting(const PenaltyPair& p, Field<const float> x, Field<const float> v)
      : normal(p.normal),
        d(between(p, x)),
        velocity(read(v, p.slot_a) - read(v, p.slot_b)),
        s(glm::dot(d, normal)),
        u(glm::dot(velocity, normal)) {}
  float d2() const { return glm::dot(d, d); }
  glm::vec3 slip() const { return velocity - u * normal; }

  glm::vec3 normal;
  glm::vec3 d, velocity;  // of a from b, m and m/s
  float s, u;             // of these, along n
};

glm::vec3 contact_normal(const State& state, const PenaltyPair& pair) {
  const glm::vec3 way = direction(between(pair, field(state.x)));
  const bool surfaces =
      pair.body_a != pair.body_b && state.model(pair.body_a).mesh.closed && state.model(pair.body_b).mesh.closed;
  if (!surfaces) return way;
  const glm::vec3 apart =
      vertex_normal(state, pair.body_b, pair.vertex_b) - vertex_normal(state, pair.body_a, pair.vertex_a);
  return glm::length(apart) > 0.5f ? glm::normalize(apart) : way;  // surfaces that face the same way tell nothing
}

}  // namespace

void PenaltyContact::find(const DetectedContacts& detected, const State& state, float layer) {
  thickness = layer;
  const std::vector<PenaltyPair> before = std::exchange(pairs, {});
  add_pairs(detected, state);
  carry_over(before);
  force.resize(pairs.size());
  group(state);
}

void PenaltyContact::add_pairs(const DetectedContacts& detected, const State& state) {
  const auto& [vertices, vertex_body, contacts] = detected;
  const auto still = [&state, bodies = vertex_body](const collide::Contact& c) {
    return !state.body(bodies[c.a]).moves() && !state.body(bodies[c.b]).moves();
  };
  const auto of_bodies = [&state](const Key& value) {
    std::vector<double> values;
    for (BodyId body = 0; body < state.body_count(); ++body) values.push_back(state.model(body).material[value]);
    return values;
  };
  const std::vector<double> stiffness = of_bodies(contact::stiffness), friction = of_bodies(contact::friction);
  std::vector<std::uint32_t> contacts_of(vertex_body.size(), 0);  // of each vertex
  for (const collide::Contact& c : contacts) {
    if (still(c)) continue;
    ++contacts_of[c.a];
    ++contacts_of[c.b];
  }
  for (const collide::Contact& c : contacts) {
    if (still(c)) continue;
    const BodyId a = vertex_body[c.a], b = vertex_body[c.b];
    const Index va = c.a - vertices.first[a], vb = c.b - vertices.first[b];
    const auto damped_mass = [&](BodyId body, Index contact_vertex) {
      return state.body(body).moves() ? state.model(body).particle_mass / double(contacts_of[contact_vertex])
                                      : std::numeric_limits<double>::infinity();
    };
    PenaltyPair& pair = pairs.emplace_back(PenaltyPair{
        .contact = c,
        .body_a = a,
        .body_b = b,
        .vertex_a = va,
        .vertex_b = vb,
        .slot_a = state.slot(a, va),
        .slot_b = state.slot(b, vb),
        .offset = glm::vec3(state.body(a).origin - state.body(b).origin),
        .normal = {},
        .stiffness = float(std::min(stiffness[a], stiffness[b]) / double(std::max(contacts_of[c.a], contacts_of[c.b]))),
        .friction = float(law::common_friction(friction[a], friction[b])),
        .damped_mass = 0});
    pair.damped_mass =
        float(std::min(damped_mass(a, c.a), damped_mass(b, c.b)) / std::sqrt(1 + pair.friction * pair.friction));
    pair.normal = contact_normal(state, pair);
  }
}

std::span<const PenaltyEnd> PenaltyContact::ends_of(const Batch& b) const {
  if (pairs.empty()) return {};
  return std::span(ends).subspan(first_end[b.index], first_end[b.index + 1] - first_end[b.index]);
}

/// Fills `ends`.
void PenaltyContact::group(const State& state) {
  const auto batch_of = [&](BodyId body) { return state.body(body).batch; };
  first_end.assign(state.batches().size() + 1, 0);
  for (const PenaltyPair& p : pairs) {
    ++first_end[batch_of(p.body_a) + 1];
    ++first_end[batch_of(p.body_b) + 1];
  }
  for (std::size_t b = 0; b + 1 < first_end.size(); ++b) first_end[b + 1] += first_end[b];
  std::vector<std::uint32_t> next(first_end.begin(), first_end.end() - 1);
  ends.resize(2 * pairs.size());
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    ends[next[batch_of(pairs[i].body_a)]++] = {pairs[i].slot_a, i, 1.0f};
    ends[next[batch_of(pairs[i].body_b)]++] = {pairs[i].slot_b, i, -1.0f};
  }
}

/// The given stiffness is for the particles of the paper's sphere. If a body has more particles, more of them share a
/// contact, so they share the stiffness, too.
void PenaltyContact::adapt(Material& material, const MeshSource& source) {
  constexpr double stated_for = 162;  // vertices
  if (source.kind == "file") material[contact::stiffness] *= std::min(1.0, stated_for / double(source.vertex_count()));
}

void PenaltyContact::add(const ForceBatch& b) const {
  const Field<float> f = field(b.state.f);
  for (const PenaltyEnd& end : ends_of(b.batch)) softbody::add(f, end.slot, end.sign * force[end.pair]);
}

template <class Real>
PenaltyLaw<Real> PenaltyContact::law_of(const PenaltyPair& pair) const {
  return {Real(pair.stiffness), Real(thickness), Real(pair.friction), Real(damper_limit * pair.damped_mass)};
}
template PenaltyLaw<double> PenaltyContact::law_of(const PenaltyPair&) const;

void PenaltyContact::evaluate(collide::Part part, Field<const float> x, Field<const float> v, float seconds) {
  for (std::size_t i = part.begin; i < part.end; ++i) {
    PenaltyPair& p = pairs[i];
    const PenaltyLaw pair_law = law_of<float>(p);
    const Meeting m(p, x, v);
    const float at_rest = pair_law.push_at_rest(m.s, m.d2());
    if (at_rest <= 0) {
      force[i] = p.stretch = glm::vec3(0.0f);
      continue;
    }
    const float push = pair_law.push(at_rest, m.u);
    p.stretch += seconds * m.slip();
    const glm::vec3 asked = pair_law.drag(p.stretch, m.slip());
    const glm::vec3 drag = law::within_cone(asked, p.friction * push);
    if (drag != asked) p.stretch = drag / p.stiffness;
    force[i] = push * p.normal - drag;
  }
}

void PenaltyContact::remove(BodyId body, Index first, Index count) {
  std::erase_if(pairs, [body](const PenaltyPair& p) { return p.body_a == body || p.body_b == body; });
  for (PenaltyPair& p : pairs) {
    for (BodyId* id : {&p.body_a, &p.body_b}) *id -= *id > body;
    for (Index* vertex : {&p.contact.a, &p.contact.b}) *vertex -= *vertex > first ? count : 0;
  }
}

PenaltyContact::Slopes PenaltyContact::slopes(const PenaltyPair& p, Field<const float> x, Field<const float> v,
                                              float seconds) const {
  const PenaltyLaw pair_law = law_of<float>(p);
  const Meeting m(p, x, v);
  const float at_rest = pair_law.push_at_rest(m.s, m.d2());
  if (at_rest <= 0) return {};
  return {pair_law.slope_bound(m.s, m.d2(), m.u), pair_law.damper(at_rest) / seconds, p.stiffness,
          pair_law.sticking_damper() / seconds};
}

double PenaltyContact::energy(const PenaltyPair& p, Field<const float> x) const {
  const glm::dvec3 d(between(p, x)), stretch(p.stretch);
  const double s = glm::dot(d, glm::dvec3(p.normal));
  const PenaltyLaw pair_law = law_of<double>(p);
  return pair_law.stored(s, glm::dot(d, d) - s * s) + pair_law.stored_by_friction(glm::dot(stretch, stretch));
}

double PenaltyContact::energy(Field<const float> x) const {
  double sum = 0;
  for (const PenaltyPair& p : pairs) sum += energy(p, x);
  return sum;
}

void PenaltyContact::carry_over(std::span<const PenaltyPair> before) {
  auto old = before.begin();
  for (PenaltyPair& p : pairs) {
    while (old != before.end() && old->contact < p.contact) ++old;
    if (old == before.end()) return;
    if (old->contact != p.contact) continue;
    p.stretch = old->stretch - glm::dot(old->stretch, p.normal) * p.normal;  // the normal may have turned
  }
}

}  // namespace softbody
