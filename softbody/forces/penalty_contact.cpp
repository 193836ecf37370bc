#include "softbody/forces/penalty_contact.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

#include "softbody/contact/keys.h"
#include "softbody/contact/rebound.h"
#include "softbody/forces/penalty_law.h"

namespace softbody {

/// Returns the law of a pair whose dampers have no limit.
template <class Real>
auto PenaltyContact::law_of(std::size_t i) const {
  return PenaltyLaw<Real>{Real(pairs().stiffness[i]), Real(layer().thickness), Real(pairs().friction[i])};
}

/// Returns the way from b to a, in m.
glm::vec3 PenaltyContact::between(std::size_t i, Field<const float> x) const {
  return read(x, pairs().slot_a[i]) - read(x, pairs().slot_b[i]) + read(field(pairs().offset), i);
}

void PenaltyContact::find(const DetectedContacts& detected, const State& state, double seconds,
                          collide::Workers& workers) {
  assert(std::ranges::is_sorted(detected.contacts) && seconds > 0);
  ContactLayer& layer = memory_.layer;
  PenaltyPairs& pairs = memory_.pairs;
  layer.tolerance = detected.tolerance;
  layer.begun = layer.thickness;
  layer.grow(seconds);
  if (detected.contacts.empty()) return clear();
  const std::vector<collide::Contact> before = std::exchange(pairs.contact, {});
  const VectorArray stretch = std::exchange(pairs.stretch, {});
  restitution_.resize(state.body_count());
  for (const Batch& b : state.batches())
    for (std::size_t l = 0; l < std::size_t(b.used); ++l)
      restitution_[b.body[l]] = float(b.model->material[contact::restitution]);
  constexpr double contact_ns = 10;  // of work, between two barriers
  const int threads = workers.threads_for(contact_ns * double(detected.contacts.size()));
  take(detected, state, workers, threads);
  group(state.x[0].size(), state.batches(), workers, threads);
  workers.run_together(threads, [&](int thread) {
    const collide::Part batches = collide::part_of(state.batches().size(), thread, threads);
    for (const Batch& batch : state.batches().subspan(batches.begin, batches.end - batches.begin)) {
      gather(batch, field(state.x), field(state.v));
      set_traits(state, batch);
    }
    workers.barrier();
    const collide::Part own = collide::part_of(pairs.size(), thread, threads);
    penalty_kernels().prepare(own, pairs, motion_.data(), traits_.data());
    workers.barrier();
    carry_over(own, before, stretch);
  });
}

/// Takes the contacts of bodies that move.
void PenaltyContact::take(const DetectedContacts& detected, const State& state, collide::Workers& workers,
                          int threads) {
  PenaltyPairs& pairs = memory_.pairs;
  const auto body = [&](Index vertex) { return detected.vertex_body[vertex]; };
  const auto acts = [&](const collide::Contact& c) {
    return state.body(body(c.a)).moves() || state.body(body(c.b)).moves();
  };
  const auto contacts_of = [&](int thread) {
    const collide::Part part = collide::part_of(detected.contacts.size(), thread, threads);
    return std::span(detected.contacts).subspan(part.begin, part.end - part.begin);
  };
  std::vector<std::size_t> first(std::size_t(threads) + 1);  // pair of each thread
  workers.run_together(threads, [&](int thread) {
    first[std::size_t(thread) + 1] = std::size_t(std::ranges::count_if(contacts_of(thread), acts));
  });
  std::partial_sum(first.begin(), first.end(), first.begin());
  pairs.resize(first.back());
  workers.run_together(threads, [&](int thread) {
    std::size_t i = first[std::size_t(thread)];
    for (const collide::Contact& c : contacts_of(thread)) {
      if (!acts(c)) continue;
      pairs.contact[i] = c;
      const BodyId a = pairs.body_a[i] = body(c.a), b = pairs.body_b[i] = body(c.b);
      pairs.restitution[i] = a == b ? 0 : law::common_restitution(restitution_[a], restitution_[b]);
      pairs.slot_a[i] = std::uint32_t(state.slot(a, c.a - detected.vertices.first[a]));
      pairs.slot_b[i] = std::uint32_t(state.slot(b, c.b - detected.vertices.first[b]));
      const glm::vec3 offset(state.body(a).origin - state.body(b).origin);
      for (int k = 0; k < 3; ++k) pairs.offset[std::size_t(k)][i] = offset[k];
      ++i;
    }
  });
}

/// Finds the particles that the pairs join by their slots, which are below `slots`, and the ends of pairs of each. Each
/// thread finds those in its part of the slots: the ends of their pairs stay in order.
void PenaltyContact::group(std::size_t slots, std::span<const Batch> batches, collide::Workers& workers, int threads) {
  assert(slots <= std::numeric_limits<std::uint32_t>::max());
  PenaltyPairs& pairs = memory_.pairs;
  const auto for_each_end = [&](const collide::Part& part, const auto& use) {
    const std::size_t count = part.end - part.begin;
    for (std::uint32_t i = 0; i < pairs.size(); ++i) {
      if (pairs.slot_a[i] - part.begin < count) use(pairs.slot_a[i] - part.begin, pairs.a[i], PenaltyEnd{i, 0});
      if (pairs.slot_b[i] - part.begin < count) use(pairs.slot_b[i] - part.begin, pairs.b[i], PenaltyEnd{i, 1});
    }
  };
  std::vector<std::size_t> particles(std::size_t(threads) + 1), ends(particles);  // the first ones of each thread
  std::vector<std::vector<std::uint32_t>> of_slots(particles.size() - 1);  // ends, and then the number of a particle
  workers.run_together(threads, [&](int thread) {
    const collide::Part part = collide::part_of(slots, thread, threads);
    std::vector<std::uint32_t> of_slot(part.end - part.begin, 0);
    for_each_end(part, [&](std::size_t slot, std::uint32_t&, PenaltyEnd) { ++of_slot[slot]; });
    particles[std::size_t(thread) + 1] = of_slot.size() - std::size_t(std::ranges::count(of_slot, 0u));
    ends[std::size_t(thread) + 1] = std::accumulate(of_slot.begin(), of_slot.end(), std::size_t{0});
    of_slots[std::size_t(thread)] = std::move(of_slot);
  });
  for (auto* sums : {&particles, &ends}) std::partial_sum(sums->begin(), sums->end(), sums->begin());
  slot_.resize(particles.back());
  first_end_.resize(particles.back() + 1);
  first_end_.back() = std::uint32_t(ends.back());
  for (auto* table : {&motion_, &traits_}) table->resize(particles.back());
  ends_.resize(ends.back());
  force_.resize(pairs.a.size());
  stored_.resize(pairs.a.size() / lanes);
  const bool bounces = std::any_of(pairs.restitution.begin(), pairs.restitution.begin() + std::ptrdiff_t(pairs.size()),
                                   [](float e) { return e > 0; });
  for (auto* sums : {&impulse_, &returned_}) sums->assign(bounces ? 2 * pairs.a.size() : 0, 0.0f);
  workers.run_together(threads, [&](int thread) {
    const collide::Part part = collide::part_of(slots, thread, threads);
    std::vector<std::uint32_t>& of_slot = of_slots[std::size_t(thread)];
    const std::size_t first = particles[std::size_t(thread)], last = particles[std::size_t(thread) + 1];
    auto particle = std::uint32_t(first), end = std::uint32_t(ends[std::size_t(thread)]);
    for (std::size_t i = 0; i < of_slot.size(); ++i) {
      if (of_slot[i] == 0) continue;
      slot_[particle] = std::uint32_t(part.begin + i);
      first_end_[particle] = end;
      end += std::exchange(of_slot[i], particle++);
    }
    std::vector<std::uint32_t> next(first_end_.begin() + std::ptrdiff_t(first),
                                    first_end_.begin() + std::ptrdiff_t(last));
    for_each_end(part, [&](std::size_t slot, std::uint32_t& of_pair, PenaltyEnd one) {
      of_pair = of_slot[slot];
      ends_[next[of_pair - first]++] = one;
    });
  });
  const auto at = [this](std::size_t slot) {
    return std::size_t(std::ranges::lower_bound(slot_, slot) - slot_.begin());
  };
  of_batch_.clear();
  for (const Batch& b : batches) of_batch_.push_back({at(b.base), at(b.base + b.values())});
}

void PenaltyContact::set_traits(const State& state, const Batch& batch) {
  const collide::Part part = particles_of(batch);
  const BodyModel& model = *batch.model;
  const auto stiffness = float(model.material[contact::stiffness]), friction = float(model.material[contact::friction]);
  const auto mass = float(model.particle_mass);
  for (std::size_t i = part.begin; i < part.end; ++i) {
    const std::size_t lane = (slot_[i] - batch.base) % std::size_t(batch.width);
    const auto contacts = float(first_end_[i + 1] - first_end_[i]);
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    traits_[i] = {
        glm::vec4(none, none, none, contacts),
        glm::vec4(stiffness, friction, batch.moves[lane] > 0 ? mass / contacts : std::numeric_limits<float>::infinity(),
                  float(batch.body[lane]))};
  }
  if (model.mesh.closed)
    penalty_kernels().set_normals(batch, field(state.x, batch.base),
                                  std::span(slot_).subspan(part.begin, part.end - part.begin),
                                  traits_.data() + part.begin);
}

void PenaltyContact::gather(collide::Part particles, Field<const float> x, Field<const float> v) {
  for (std::size_t i = particles.begin; i < particles.end; ++i)
    motion_[i] = {glm::vec4(read(x, slot_[i]), 0), glm::vec4(read(v, slot_[i]), 0)};
}

std::span<const PenaltyEnd> PenaltyContact::ends_of(const Batch& b) const {
  const auto [begin, end] = particles_of(b);
  if (begin == end) return {};
  return std::span(ends_).subspan(first_end_[begin], first_end_[end] - first_end_[begin]);
}

/// The given stiffness is for the particles of the mesh that it is stated for. If a body has more particles, more of
/// them share a contact, so they share the stiffness, too.
void PenaltyContact::adapt(Material& material, const Mesh& mesh) {
  material[contact::stiffness] *= std::min(1.0, mesh.stated_for / double(mesh.vertices.size()));
}

void PenaltyContact::add(const ForceBatch& b) const {
  const auto [begin, end] = particles_of(b.batch);
  if (begin == end) return;
  penalty_kernels().add(std::span(slot_).subspan(begin, end - begin), first_end_.data() + begin, ends_.data(),
                        force_.data(), b.batch.base, b.f);
}

double PenaltyContact::stored_energy(collide::Workers& workers, int threads) {
  if (pairs().empty()) return 0;
  workers.run_together(threads, [&](int thread) {
    penalty_kernels().measure(collide::part_of(pairs().size(), thread, threads), pairs(), motion_.data(),
                              layer().thickness, stored_.data());
  });
  return std::accumulate(stored_.begin(), stored_.end(), 0.0);
}

void PenaltyContact::add_impact(PenaltyEnd end, double impulse, double taken) {
  assert(bounces() && end.pair < pairs().size());
  const std::size_t at = end.pair + (end.at_b ? pairs().a.size() : 0);
  const float e = pairs().restitution[end.pair];
  impulse_[at] += float(impulse);
  returned_[at] += e * e * float(taken);
}

void PenaltyContact::take_impacts(Rebounds& rebounds) {
  const auto impulses = std::exchange(impulse_, {}), returned = std::exchange(returned_, {});
  if (impulses.empty()) return;
  const PenaltyPairs& pairs = memory_.pairs;
  const std::size_t b = pairs.a.size();
  assert(impulses.size() == 2 * b);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const float impulse = impulses[i] + impulses[b + i];
    if (impulse == 0 || pairs.restitution[i] <= 0) continue;
    rebounds.add({pairs.body_a[i], pairs.body_b[i], glm::dvec3(impulse * read(field(pairs.normal), i)),
                  double(returned[i] + returned[b + i])});
  }
}

void PenaltyContact::remove(BodyId body, Index first, Index count) {
  PenaltyPairs& pairs = memory_.pairs;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (pairs.body_a[i] != body && pairs.body_b[i] != body) kept.push_back(i);
  pairs.keep(kept);
  for (auto* bodies : {&pairs.body_a, &pairs.body_b})
    for (BodyId& id : *bodies) id -= id > body;
  for (collide::Contact& c : pairs.contact)
    for (Index* vertex : {&c.a, &c.b}) *vertex -= *vertex > first ? count : 0;
}

PenaltyContact::Slopes PenaltyContact::slopes(std::size_t i, Field<const float> x, Field<const float> v,
                                              float seconds) const {
  const PenaltyLaw law = law_of<float>(i);
  const glm::vec3 d = between(i, x), normal = read(field(pairs().normal), i);
  const float s = glm::dot(d, normal), u = glm::dot(read(v, pairs().slot_a[i]) - read(v, pairs().slot_b[i]), normal);
  const float at_rest = law.push_at_rest(s, glm::dot(d, d));
  if (at_rest <= 0) return {};
  return {law.slope_bound(s, glm::dot(d, d), u), law.damper(at_rest) / seconds, pairs().stiffness[i],
          law.sticking_damper() / seconds};
}

double PenaltyContact::energy(std::size_t i, Field<const float> x, const glm::dvec3& way) const {
  const glm::dvec3 d = glm::dvec3(between(i, x)) + way, stretch(read(field(pairs().stretch), i));
  const double s = glm::dot(d, glm::dvec3(read(field(pairs().normal), i)));
  const PenaltyLaw law = law_of<double>(i);
  return law.stored(s, glm::dot(d, d) - s * s) + law.stored_by_friction(glm::dot(stretch, stretch));
}

double PenaltyContact::max_work(std::size_t i, Field<const float> x, double way) const {
  return PenaltyLaw<double>::approach_limit * energy(i, x) + law_of<double>(i).max_force() * way;
}

/// Hands the friction springs of the contacts `before` on to the same contacts of a part of the pairs; both ascend.
void PenaltyContact::carry_over(collide::Part part, std::span<const collide::Contact> before,
                                const VectorArray& stretch) {
  if (part.begin == part.end) return;
  PenaltyPairs& pairs = memory_.pairs;
  auto old = std::ranges::lower_bound(before, pairs.contact[part.begin]);
  for (std::size_t i = part.begin; i < part.end; ++i) {
    while (old != before.end() && *old < pairs.contact[i]) ++old;
    const bool known = old != before.end() && *old == pairs.contact[i];
    const glm::vec3 normal = read(field(std::as_const(pairs.normal)), i);
    const glm::vec3 was = known ? read(field(stretch), std::size_t(old - before.begin())) : glm::vec3(0.0f);
    const glm::vec3 now = was - glm::dot(was, normal) * normal;  // the normal may have turned
    for (int k = 0; k < 3; ++k) pairs.stretch[std::size_t(k)][i] = now[k];
  }
}

}  // namespace softbody
