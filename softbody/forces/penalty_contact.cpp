#include "softbody/forces/penalty_contact.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "softbody/contact/law.h"

namespace softbody {

/// The given stiffness is for the particles of the paper's sphere. If a body has more particles, more of them share a
/// contact, so they share the stiffness, too.
void PenaltyContact::adapt(Material& material, const MeshSource& source) {
  constexpr double stated_for = 162;  // vertices
  if (source.kind == "file") material[stiffness] *= std::min(1.0, stated_for / double(source.vertex_count()));
}

void PenaltyContact::add(const ForceBatch& b) const {
  if (pairs.empty()) return;
  for (std::uint32_t e = first_end[b.index]; e < first_end[b.index + 1]; ++e)
    softbody::add(b.f, ends[e].slot, ends[e].sign * force[ends[e].pair]);
}

void PenaltyContact::evaluate(collide::Part part, Field<const float> x, Field<const float> v, float seconds) {
  const float h = thickness;
  for (std::size_t i = part.begin; i < part.end; ++i) {
    PenaltyPair& p = pairs[i];
    force[i] = glm::vec3(0.0f);
    const glm::vec3 d = read(x, p.slot_a) - read(x, p.slot_b) + p.offset;
    const float s = glm::dot(d, p.normal);
    const float beyond = std::min(s, 0.0f);
    const float weight = 1 - (glm::dot(d, d) - beyond * beyond) / (h * h);
    if (weight <= 0) {
      p.stretch = glm::vec3(0.0f);
      continue;
    }
    const glm::vec3 velocity = read(v, p.slot_a) - read(v, p.slot_b);
    const float separating = glm::dot(velocity, p.normal);
    const float damping = std::clamp(1 - separating / rebound_speed, 0.0f, approach_limit);
    const float push = p.stiffness * weight * std::min(h - s, h) * damping;
    const glm::vec3 slip = velocity - separating * p.normal;
    const float viscous = sticking_damping * p.stiffness * h / rebound_speed;
    p.stretch += seconds * slip;
    const glm::vec3 asked = p.stiffness * p.stretch + viscous * slip;
    const glm::vec3 drag = law::within_cone(asked, p.friction * push);
    if (drag != asked) p.stretch = drag / p.stiffness;
    force[i] = push * p.normal - drag;
  }
}

void PenaltyContact::remove(BodyId body, collide::Index first, collide::Index count) {
  std::erase_if(pairs, [body](const PenaltyPair& p) { return p.body_a == body || p.body_b == body; });
  for (PenaltyPair& p : pairs) {
    for (BodyId* id : {&p.body_a, &p.body_b}) *id -= *id > body;
    for (collide::Index* vertex : {&p.contact.a, &p.contact.b}) *vertex -= *vertex > first ? count : 0;
  }
}

PenaltyContact::Slopes PenaltyContact::slopes(const PenaltyPair& p, Field<const float> x, Field<const float> v,
                                              float seconds) const {
  const float h = thickness;
  const glm::vec3 d = read(x, p.slot_a) - read(x, p.slot_b) + p.offset;
  const float s = glm::dot(d, p.normal), beyond = std::min(s, 0.0f);
  const float weight = 1 - (glm::dot(d, d) - beyond * beyond) / (h * h);
  if (weight <= 0) return {};
  const float separating = glm::dot(read(v, p.slot_a) - read(v, p.slot_b), p.normal);
  const float damping = std::clamp(1 - separating / rebound_speed, 0.0f, approach_limit);
  const float depth = std::min(h - s, h);
  // The weight falls with s, too: by 2 s / h^2 times a depth of h - s, together at most a half.
  const float spring = p.stiffness * damping * (weight + 0.5f);
  const float damper = p.stiffness * weight * depth / (rebound_speed * seconds);
  return {spring, damper, p.stiffness, sticking_damping * p.stiffness * h / (rebound_speed * seconds)};
}

float PenaltyContact::predicted_damping(const PenaltyPair& p, Field<const float> x, Field<const float> v,
                                        float seconds) const {
  const glm::vec3 d = read(x, p.slot_a) - read(x, p.slot_b) + p.offset;
  const glm::vec3 velocity = read(v, p.slot_a) - read(v, p.slot_b);
  const float s = glm::dot(d, p.normal), u = glm::dot(velocity, p.normal);
  const float nearer = seconds * glm::length(velocity - u * p.normal);
  const float across = std::max(0.0f, glm::length(d - s * p.normal) - nearer) / thickness;
  const float along = std::max(0.0f, s + seconds * std::min(u, 0.0f)) / thickness;
  const float depth = std::max(0.0f, 1 - across * across - along * along) * std::max(0.0f, 1 - along);
  return p.stiffness * thickness / rebound_speed * std::max(sticking_damping, max_damping(p.friction) * depth);
}

double PenaltyContact::energy(const PenaltyPair& p, Field<const float> x) const {
  const double h = thickness;
  const glm::dvec3 d(read(x, p.slot_a) - read(x, p.slot_b) + p.offset);
  const double s = glm::dot(d, glm::dvec3(p.normal)), k = double(p.stiffness);
  const double end2 = h * h - (glm::dot(d, d) - s * s);  // of s, where the weight has come to 0, squared
  if (end2 <= 0 || s >= std::sqrt(end2)) return 0;
  // (end2 - s^2) (h - s), integrated; below 0 the force stays as it is there.
  const auto integral = [&](double t) {
    return end2 * h * t - end2 * t * t / 2 - h * t * t * t / 3 + t * t * t * t / 4;
  };
  const double push = integral(std::sqrt(end2)) - integral(std::max(s, 0.0)) + end2 * h * std::max(-s, 0.0);
  const glm::dvec3 stretch(p.stretch);
  // At the edge of sight the two integrals differ by less than they are rounded by.
  return k / (h * h) * std::max(0.0, push) + k / 2 * glm::dot(stretch, stretch);
}

double total(std::span<const PairEnergy> pairs) {
  double sum = 0;
  for (const PairEnergy& p : pairs) sum += p.joules;
  return sum;
}

std::vector<PairEnergy> PenaltyContact::energies(Field<const float> x) const {
  std::vector<PairEnergy> list;
  for (const PenaltyPair& p : pairs) list.push_back({p.contact, energy(p, x)});
  return list;
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
