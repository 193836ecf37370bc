#include "softbody/contact/rebound.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "softbody/contact/law.h"

namespace softbody {

glm::dvec3 rebound(Impact& impact, const glm::dvec3& impulse, double returned, const glm::dvec3& before,
                   const glm::dvec3& after, double mass, double seconds) {
  // s; a ball may pause before it swings back, and an implicit step may miss the contact of a body that swings.
  constexpr double wait_in_contact = 0.1, wait = 0.02;
  constexpr double longest_gap = 0.05;  // s; the other one may swing out of its way
  constexpr double growth = 1;          // 1/s; what grows more slowly does so in a rebound without end, too
  assert(mass > 0 && seconds >= 0);
  impact.given = 0;
  const double push = glm::length(impulse);
  const glm::dvec3 normal = push > 0 ? impulse / push : glm::dvec3(0.0);
  if (const double approach = -glm::dot(before, normal); approach > law::impact_speed) {
    if (impact.speed <= 0) impact.parting = float(-approach);
    impact.speed = std::max(impact.speed, float(approach));
  }
  if (impact.speed <= 0) return glm::dvec3(0.0);
  impact.energy += returned * normal;
  if (glm::dot(impact.energy, normal) < 0) impact.energy = glm::dvec3(0.0);  // it pushes out more than it took
  const double energy = glm::length(impact.energy);
  const glm::dvec3 way = energy > 0 ? impact.energy / energy : normal;
  const double parting = glm::dot(after, way), came = double(impact.speed);
  const bool grows = push > 0 && parting > double(impact.parting) + growth * came * seconds;
  if (push > 0) impact.parting = float(parting);
  const bool still_came = double(impact.parting) < -0.02 * came;
  impact.calm = grows || (push > 0 && still_came) ? 0 : impact.calm + float(seconds);
  if (still_came && double(impact.calm) > longest_gap) impact = {};  // it has come past, and meets something else next
  if (still_came || double(impact.calm) < (push > 0 ? wait_in_contact : wait)) return glm::dvec3(0.0);
  // No faster than it came.
  const double speed = std::min(std::sqrt(parting * parting + 2 * energy / mass), std::max(parting, came));
  impact.given = float(mass / 2 * (speed * speed - parting * parting));
  impact.energy = glm::dvec3(0.0);
  if (push <= 0 || speed < law::impact_speed) impact.speed = 0;  // it is over
  return (speed - parting) * way;
}

void Rebounds::add(const Pair& done) {
  const auto bodies = [](const Pair& p) { return std::pair(p.a, p.b); };
  auto found = std::ranges::lower_bound(pairs_, bodies(done), {}, bodies);
  if (found == pairs_.end() || bodies(*found) != bodies(done)) found = pairs_.insert(found, {done.a, done.b});
  found->impulse += done.impulse;
  found->returned += done.returned;
}

double Rebounds::give_back(State& state, double seconds) {
  const auto inverse_mass = [&](BodyId id) {
    return state.body(id).moves() && state.held.of(id).empty() ? 1 / state.model(id).material[Material::mass] : 0;
  };
  const auto velocity = [&](BodyId id) {  // of a body that is held somewhere: of what is held
    const BodyField v = state.field_of(id, state.v);
    const std::span<const char> held = state.held.of(id);
    const std::size_t all = state.batch_of(id).particles();
    const auto count = double(held.empty() ? all : std::size_t(std::ranges::count(held, 1)));
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < all && state.body(id).moves(); ++i)
      if (held.empty() || held[i]) sum += v(i) / count;
    return sum;
  };
  double given = 0;
  for (Pair& p : pairs_) {
    const double a = inverse_mass(p.a), b = inverse_mass(p.b);
    if (a + b <= 0) {
      p.impact = {};  // they sleep, or are held
      continue;
    }
    const double mass = 1 / (a + b);
    const glm::dvec3 impulse = std::exchange(p.impulse, glm::dvec3(0.0)), after = velocity(p.a) - velocity(p.b);
    const glm::dvec3 change =
        rebound(p.impact, impulse, std::exchange(p.returned, 0.0), after - impulse / mass, after, mass, seconds);
    given += double(std::exchange(p.impact.given, 0.0f));
    if (change == glm::dvec3(0.0)) continue;
    // Who pushes off what is held and moves gets work from it.
    if (a <= 0 || b <= 0) given += mass * (b <= 0 ? glm::dot(change, velocity(p.b)) : -glm::dot(change, velocity(p.a)));
    for (const auto& [id, share] : {std::pair(p.a, mass * a), std::pair(p.b, -mass * b)})
      for (std::size_t i = 0; i < state.batch_of(id).particles(); ++i)
        state.field_of(id, state.v).add(i, share * change);
  }
  std::erase_if(pairs_, [](const Pair& p) { return p.impact.speed <= 0; });
  return given;
}

void Rebounds::forget(BodyId body) {
  std::erase_if(pairs_, [&](const Pair& p) { return p.a == body || p.b == body; });
}

void Rebounds::remove(BodyId body) {
  forget(body);
  for (Pair& p : pairs_)
    for (BodyId* id : {&p.a, &p.b}) *id -= *id > body;
}

}  // namespace softbody
