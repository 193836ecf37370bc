// Surface contact: the impulses of a substep.

#include <algorithm>

#include <glm/common.hpp>

#include "softbody/contact/law.h"
#include "softbody/contact/surface_contact.h"
#include "softbody/contact/surface_vectors.h"

namespace softbody {
namespace {

void apply(const ContactRow& row, const glm::vec3& impulse, Field<float> v) {
  for (std::size_t k = 0; k < 4; ++k) add(v, row.slot[k], row.mobility[k] * impulse);
}

}  // namespace

void solve_row(ContactRow& row, Field<float> v) {
  glm::vec3 velocity = relative_velocity(row, v);
  const float speed = glm::dot(velocity, row.normal);
  const float held =
      row.relative_stiffness / (1 + row.relative_stiffness) * (row.normal_impulse + row.mass * (row.bias - speed));
  const float normal_impulse = std::max({0.0f, held, row.normal_impulse + row.mass * (row.target - speed)});
  if (normal_impulse == 0 && row.normal_impulse == 0) return;
  const float push = normal_impulse - row.normal_impulse;
  row.normal_impulse = normal_impulse;
  velocity += (push / row.mass) * row.normal;
  const glm::vec3 slip = velocity - glm::dot(velocity, row.normal) * row.normal;
  const glm::vec3 friction_impulse =
      law::within_cone(row.friction_impulse - row.mass * slip, row.friction * normal_impulse);
  apply(row, push * row.normal + (friction_impulse - row.friction_impulse), v);
  row.friction_impulse = friction_impulse;
}

/// Two bodies far inside each other move apart along the line of their centres, each as a whole: their shapes, momentum
/// and angular momentum stay.
void SurfaceContact::separate(const Pair& pair, Field<const float> x, Field<float> v) const {
  struct Whole {
    glm::vec3 centre{0.0f}, velocity{0.0f};
    float inverse_mass = 0;
  };
  const auto whole = [&](const SurfaceCandidates::Side& s) {
    Whole w;
    const Index count = s.surface->vertex_count();
    for (Index i = 0; i < count; ++i) {
      w.centre += (read(x, s.slot + i * s.stride) + s.offset) / static_cast<float>(count);
      w.velocity += read(v, s.slot + i * s.stride) / static_cast<float>(count);
    }
    w.inverse_mass = s.inverse_mass / static_cast<float>(count);
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
  for (Index i = 0; i < one.surface->vertex_count(); ++i)
    add(v, one.slot + i * one.stride, impulse * a.inverse_mass * axis);
  for (Index i = 0; i < two.surface->vertex_count(); ++i)
    add(v, two.slot + i * two.stride, -impulse * b.inverse_mass * axis);
}

bool SurfaceContact::needs_more_iterations(float h) const {
  return std::ranges::any_of(candidates_.pairs(), [&](const Pair& p) { return needs_more_iterations(p, h); });
}

/// visit(pair, its rows): colour by colour, each by one thread. A few rows are done by the first thread before all have
/// met at every colour; the others do not wait for it.
template <class Visit>
void SurfaceContact::for_each_pair(int thread, int threads, const std::function<void()>& barrier, const Visit& visit) {
  const bool alone = few_rows();
  for (const auto& colour : candidates_.colours()) {
    const collide::Part part =
        alone ? collide::Part{0, thread == 0 ? colour.size() : 0} : collide::part_of(colour.size(), thread, threads);
    for (std::size_t i = part.begin; i < part.end; ++i) {
      const Pair& p = candidates_.pairs()[colour[i]];
      visit(p, std::span(thread_work_[static_cast<std::size_t>(p.thread)].rows).subspan(p.first_row, p.rows));
    }
    if (!alone) barrier();
  }
}

void SurfaceContact::solve(int thread, int threads, Field<const float> x, Field<float> v, float h,
                           const std::function<void()>& barrier) {
  const auto pass = [&](const auto& takes_part, const auto& visit, bool separating = false) {
    for_each_pair(thread, threads, barrier, [&](const Pair& p, std::span<ContactRow> rows) {
      if (!takes_part(p)) return;
      if (separating && p.separating) separate(p, x, v);
      std::for_each(rows.begin(), rows.end(), visit);
    });
  };
  const auto all = [](const Pair&) { return true; };
  pass(all, [&](ContactRow& row) {
    if (row.normal_impulse > 0) apply(row, row.normal_impulse * row.normal + row.friction_impulse, v);
  });
  const auto round = [&](ContactRow& row) { solve_row(row, v); };
  if (needs_more_iterations(h))
    for (int i = iterations; i < max_iterations; ++i)
      pass([&](const Pair& p) { return needs_more_iterations(p, h); }, round, true);
  for (int i = 1; i < iterations; ++i) pass(all, round, true);
  pass(
      all,
      [&](ContactRow& row) {
        solve_row(row, v);
        if (row.feature == uncached) return;
        candidates_.cached(row.feature).normal_impulse = row.normal_impulse;
        candidates_.cached(row.feature).friction_impulse = row.friction_impulse;
      },
      true);
  if (thread == 0) last_h_ = h;
  if (few_rows()) barrier();
}

/// Whether a contact uses up of the distance what it has to leave.
bool SurfaceContact::violates_target(const Pair& pair, Field<const float> v, float h) const {
  constexpr float hair = 0.02f;  // of the distance
  return std::ranges::any_of(rows_of(pair), [&](const ContactRow& row) {
    return h * (row.target - glm::dot(relative_velocity(row, v), row.normal)) > hair * pair.distance;
  });
}

bool SurfaceContact::resolve_after_solids(int thread, int threads, Field<float> v, float h,
                                          const std::function<void()>& barrier) {
  bool& mine = thread_work_[static_cast<std::size_t>(thread)].violated;
  mine = false;
  for_each_pair(thread, threads, barrier, [&](const Pair& p, std::span<ContactRow> rows) {
    if (!needs_more_iterations(p, h) || !violates_target(p, v, h)) return;
    mine = true;
    for (ContactRow& row : rows) solve_row(row, v);
  });
  if (few_rows()) barrier();
  return std::any_of(thread_work_.begin(), thread_work_.begin() + threads,
                     [](const ThreadWork& t) { return t.violated; });
}

double SurfaceContact::work_of_substep(float h) const {
  auto work = double(candidates_.search().features().size());
  for (const Pair& p : candidates_.pairs()) {
    const Index whole = p.separating ? candidates_.side(p, false).surface->vertex_count() +
                                           candidates_.side(p, true).surface->vertex_count()
                                     : 0;
    const int solves = needs_more_iterations(p, h) ? max_iterations : iterations,
              extra_passes = needs_more_iterations(p, h) ? max_passes : 0;
    work += 0.5 * (double(solves) * double(p.rows + whole) + double(extra_passes) * p.rows);
  }
  return work;
}

}  // namespace softbody
