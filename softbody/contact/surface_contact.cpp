#include "softbody/contact/surface_contact.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include <glm/common.hpp>

#include "softbody/contact/law.h"
#include "softbody/contact/surface_vectors.h"
#include "softbody/mesh/sets.h"

namespace softbody {

void SurfaceContact::make_rows(int thread, int threads, Field<const float> x, Field<const float> before, float elapsed,
                               float h) {
  assert(thread >= 0 && std::size_t(thread) < of_thread_.size() && h > 0);
  OfThread& own = of_thread_[std::size_t(thread)];
  own.rows.clear();
  SurfaceRowMaker maker(candidates_, {x, before, h, elapsed + h, last_h_ > 0 ? h / last_h_ : 0}, own.scratch, own.rows);
  // As many candidates each: few pairs may have most of them.
  const collide::Part part = collide::part_of(candidates_.search().features().size() + 1, thread, threads);
  for (Pair& p : candidates_.pairs()) {
    const std::size_t middle = (std::size_t(p.range.vertex_face) + p.range.end) / 2;
    if (middle < part.begin || middle >= part.end) continue;
    p.thread = thread;
    p.closes = p.joins = false;
    maker.add_rows(p);
  }
}

std::size_t SurfaceContact::rows() const {
  std::size_t sum = 0;
  for (const Pair& p : candidates_.pairs()) sum += p.rows;
  return sum;
}

bool SurfaceContact::presses() const {
  return std::ranges::any_of(candidates_.pairs(), [&](const Pair& p) {
    return std::ranges::any_of(rows_of(p), [](const ContactRow& row) { return row.normal_impulse > 0; });
  });
}

std::vector<SurfaceContactPoint> SurfaceContact::contact_points(const collide::Bodies& vertices) const {
  std::vector<SurfaceContactPoint> list;
  for (const Pair& p : candidates_.pairs())
    for (const ContactRow& row : rows_of(p)) {
      if (row.normal_impulse <= 0) continue;
      SurfaceContactPoint& point = list.emplace_back();
      point.a = candidates_.vertex_at(p, row.slot[0]).first;
      point.b = candidates_.vertex_at(p, row.slot[3]).first;
      point.weight = row.weight;
      point.normal = row.normal;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto& [body, vertex] = candidates_.vertex_at(p, row.slot[k]);
        point.vertex[k] = vertices.first[body] + vertex;
      }
    }
  return list;
}

/// Keeps only features of which something is remembered, see SurfaceCandidates::save(), and rows that pressed.
SurfaceContact::State SurfaceContact::save() const {
  State state{.candidates = candidates_.save(), .rows = {}, .last_h = last_h_};
  for (Pair& kept : state.candidates.pairs) {
    const std::span<const ContactRow> rows = rows_of(kept);
    kept.thread = 0;
    kept.first_row = std::uint32_t(state.rows.size());
    std::ranges::copy_if(rows, std::back_inserter(state.rows),
                         [](const ContactRow& row) { return row.normal_impulse > 0; });
    kept.rows = std::uint32_t(state.rows.size()) - kept.first_row;
  }
  return state;
}

void SurfaceContact::restore(const State& state) {
  candidates_.restore(state.candidates);
  of_thread_.resize(std::max(of_thread_.size(), std::size_t{1}));
  for (OfThread& own : of_thread_) own.joint_work = 0;
  of_thread_[0].rows = state.rows;
  last_h_ = state.last_h;
}

void solve_row(ContactRow& row, Field<float> v) {
  glm::vec3 velocity = relative_velocity(row, v);
  const float speed = glm::dot(velocity, row.normal);
  row.energy = row.returned = 0;
  if (row.normal_impulse == 0 && speed >= row.target && (speed >= row.bias || row.relative_stiffness == 0)) return;
  const float held =
      row.relative_stiffness / (1 + row.relative_stiffness) * (row.normal_impulse + row.mass * (row.bias - speed));
  const float normal_impulse = std::max({0.0f, held, row.normal_impulse + row.mass * (row.target - speed)});
  const float push = normal_impulse - row.normal_impulse;
  row.normal_impulse = normal_impulse;
  velocity += (push / row.mass) * row.normal;
  const glm::vec3 slip = velocity - glm::dot(velocity, row.normal) * row.normal;
  const glm::vec3 friction_impulse =
      law::within_cone(row.friction_impulse - row.mass * slip, row.friction * normal_impulse);
  apply(row, push * row.normal + (friction_impulse - row.friction_impulse), v);
  row.friction_impulse = friction_impulse;
  const float after = speed + push / row.mass;
  row.energy = normal_impulse * std::clamp(after, 0.0f, row.push);
  row.returned = law::bounce_energy(normal_impulse, row.before, after, row.restitution);
}

/// Two bodies far inside each other move apart along the line of their centres, each as a whole: their shapes, momentum
/// and angular momentum stay.
void SurfaceContact::separate(Pair& pair, Field<const float> x, Field<float> v) const {
  struct Whole {
    glm::vec3 centre{0.0f}, velocity{0.0f};
    float inverse_mass = 0;
  };
  const auto whole = [&](const SurfaceCandidates::Side& s) {
    Whole w;
    const Index count = s.surface->vertex_count();
    for (Index i = 0; i < count; ++i) {
      w.centre += (read(x, s.slot + i * s.stride) + s.offset) / float(count);
      w.velocity += read(v, s.slot + i * s.stride) / float(count);
    }
    w.inverse_mass = s.inverse_mass / float(count);
    return w;
  };
  const SurfaceCandidates::Side one = candidates_.side(pair, false), two = candidates_.side(pair, true);
  const Whole a = whole(one), b = whole(two);
  // In one place, each pair of many goes another way.
  const auto spread = [](Index i) { return glm::fract(float(i + 1) * glm::vec3(0.8191725f, 0.6710436f, 0.5497005f)); };
  const glm::vec3 axis = unit(a.centre - b.centre, spread(pair.range.a) - spread(pair.range.b));
  const float missing = float(law::max_separation_speed) - glm::dot(a.velocity - b.velocity, axis);
  if (missing <= 0) return;
  const float impulse = missing / (a.inverse_mass + b.inverse_mass);
  pair.energy += double(impulse * (float(law::max_separation_speed) - 0.5f * missing));
  for (Index i = 0; i < one.surface->vertex_count(); ++i)
    add(v, one.slot + i * one.stride, impulse * a.inverse_mass * axis);
  for (Index i = 0; i < two.surface->vertex_count(); ++i)
    add(v, two.slot + i * two.stride, -impulse * b.inverse_mass * axis);
}

/// Each pass goes colour by colour, each pair is solved by one thread. A few rows are done by the first thread before
/// all have met at every colour; the others do not wait for it.
void SurfaceContact::solve(int thread, int threads, Field<const float> x, Field<float> v, float h,
                           const std::function<void()>& barrier) {
  constexpr std::size_t few_rows = 2000;
  const bool alone = rows() < few_rows;
  const auto pass = [&](const auto& visit) {
    for (const auto& colour : candidates_.colours()) {
      const collide::Part part =
          alone ? collide::Part{0, thread == 0 ? colour.size() : 0} : collide::part_of(colour.size(), thread, threads);
      for (std::size_t i = part.begin; i < part.end; ++i) {
        Pair& p = candidates_.pairs()[colour[i]];
        if (p.separating) separate(p, x, v);
        std::ranges::for_each(rows_of(p), visit);
      }
      if (!alone) barrier();
    }
  };
  pass([&](ContactRow& row) {
    if (row.normal_impulse > 0) apply(row, row.normal_impulse * row.normal + row.friction_impulse, v);
  });
  for (int i = 1; i < iterations; ++i) pass([&](ContactRow& row) { solve_row(row, v); });
  pass([&](ContactRow& row) {
    solve_row(row, v);
    keep(row);
  });
  if (thread == 0) {
    for (OfThread& own : of_thread_) own.joint_work = 0;
    last_h_ = h;
  }
  if (alone) barrier();
}

void SurfaceContact::keep(const ContactRow& row) {
  if (row.feature == uncached) return;
  candidates_.cached(row.feature).normal_impulse = row.normal_impulse;
  candidates_.cached(row.feature).friction_impulse = row.friction_impulse;
}

bool SurfaceContact::find_islands(int thread, int threads, Field<const float> v, const std::function<void()>& barrier) {
  std::vector<Pair>& pairs = candidates_.pairs();
  const collide::Part part = collide::part_of(pairs.size(), thread, threads);
  for (std::size_t i = part.begin; i < part.end; ++i) {
    Pair& p = pairs[i];
    p.closes = std::ranges::any_of(rows_of(p), [&](const ContactRow& row) { return misses_target(row, v); });
    p.joins = p.joins || p.closes;
  }
  barrier();
  if (std::ranges::none_of(pairs, &Pair::closes)) return false;
  if (thread == 0) join_islands();
  barrier();
  return true;
}

/// Pairs that have closed in this substep and share bodies are an island: it grows where a solve closes others.
void SurfaceContact::join_islands() {
  const std::vector<Pair>& pairs = candidates_.pairs();
  Sets joined(candidates_.body_count());
  for (const Pair& p : pairs)
    if (p.joins) joined.unite(p.range.a, p.range.b);
  islands_.clear();
  std::vector<std::size_t> place(candidates_.body_count(), pairs.size());
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    if (!pairs[i].joins) continue;
    std::size_t& at = place[joined.find(pairs[i].range.a)];
    if (at == pairs.size()) {
      at = islands_.size();
      islands_.emplace_back();
    }
    Island& island = islands_[at];
    island.pairs.push_back(i);
    island.speed = std::max(island.speed, pairs[i].speed);
    island.closes = island.closes || pairs[i].closes;
    for (const Index body : {pairs[i].range.a, pairs[i].range.b})
      if (std::ranges::find(island.bodies, body) == island.bodies.end()) island.bodies.push_back(body);
  }
}

void SurfaceContact::solve_island(int thread, const Island& island, std::span<ContactRow> solids, Field<float> v) {
  OfThread& own = of_thread_[std::size_t(thread)];
  own.together.clear();
  for (const std::uint32_t i : island.pairs)
    for (ContactRow& row : rows_of(candidates_.pairs()[i])) own.together.push_back(&row);
  const auto surfaces = std::ptrdiff_t(own.together.size());
  for (ContactRow& row : solids) own.together.push_back(&row);
  own.joint_work += double(own.joint.solve(own.together, v)) * double(own.together.size());
  std::for_each(own.together.begin(), own.together.begin() + surfaces, [&](const ContactRow* row) { keep(*row); });
}

void SurfaceContact::add_row_work(int thread, int threads, Field<const float> v) {
  const collide::Part part = collide::part_of(candidates_.pairs().size(), thread, threads);
  for (Pair& p : std::span(candidates_.pairs()).subspan(part.begin, part.end - part.begin)) {
    const bool holds = !candidates_.side(p, false).held.empty() || !candidates_.side(p, true).held.empty();
    for (const ContactRow& row : rows_of(p)) {
      p.energy += double(row.energy);
      if (holds) p.energy += double(work_of_holders(row, v));
      if (p.restitution <= 0) continue;
      p.returned += double(row.returned);
      p.impulse += glm::dvec3(row.normal_impulse * row.normal);
    }
  }
}

double SurfaceContact::take_work(Rebounds& rebounds) {
  double sum = 0;
  for (Pair& p : candidates_.pairs()) {
    sum += std::exchange(p.energy, 0.0);
    if (p.impulse == glm::dvec3(0.0)) continue;
    rebounds.add({p.range.a, p.range.b, std::exchange(p.impulse, glm::dvec3(0.0)), std::exchange(p.returned, 0.0)});
  }
  return sum;
}

double SurfaceContact::work_of_substep() const {
  auto work = double(candidates_.search().features().size());
  for (const Pair& p : candidates_.pairs()) {
    const Index whole = p.separating ? candidates_.side(p, false).surface->vertex_count() +
                                           candidates_.side(p, true).surface->vertex_count()
                                     : 0;
    work += 0.5 * iterations * double(p.rows + whole);
  }
  for (const OfThread& of_thread : of_thread_) work += 0.5 * of_thread.joint_work;
  return work;
}

}  // namespace softbody
