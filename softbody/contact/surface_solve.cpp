// Surface contact: the impulses of a substep.

#include <algorithm>

#include <glm/common.hpp>

#include "softbody/contact/law.h"
#include "softbody/contact/surface_vectors.h"

namespace softbody {
namespace {

void apply(const ContactRow& row, const glm::vec3& impulse, Field<float> v) {
  for (std::size_t k = 0; k < 4; ++k) add(v, row.slot[k], row.mobility[k] * impulse);
}

}  // namespace

float solve_row(ContactRow& row, Field<float> v) {
  glm::vec3 velocity = relative_velocity(row, v);
  const float speed = glm::dot(velocity, row.normal);
  const float held =
      row.relative_stiffness / (1 + row.relative_stiffness) * (row.normal_impulse + row.mass * (row.bias - speed));
  const float normal_impulse = std::max({0.0f, held, row.normal_impulse + row.mass * (row.target - speed)});
  if (normal_impulse == 0 && row.normal_impulse == 0) return 0;
  const float push = normal_impulse - row.normal_impulse;
  row.normal_impulse = normal_impulse;
  velocity += (push / row.mass) * row.normal;
  const glm::vec3 slip = velocity - glm::dot(velocity, row.normal) * row.normal;
  const glm::vec3 friction_impulse =
      law::within_cone(row.friction_impulse - row.mass * slip, row.friction * normal_impulse);
  apply(row, push * row.normal + (friction_impulse - row.friction_impulse), v);
  row.friction_impulse = friction_impulse;
  return normal_impulse * std::clamp(speed + push / row.mass, 0.0f, row.push);
}

/// Two bodies far inside each other move apart along the line of their centres, each as a whole: their shapes, momentum
/// and angular momentum stay.
void SurfaceContact::separate(Pair& pair, Field<const float> x, Field<float> v) const {
  struct Whole {
    glm::vec3 centre{0.0f}, velocity{0.0f};
    float inverse_mass = 0;
  };
  const auto whole = [&](const Side& s) {
    Whole w;
    const Index count = s.surface->vertex_count();
    for (Index i = 0; i < count; ++i) {
      w.centre += (read(x, s.slot + i * s.stride) + s.offset) / static_cast<float>(count);
      w.velocity += read(v, s.slot + i * s.stride) / static_cast<float>(count);
    }
    w.inverse_mass = s.inverse_mass / static_cast<float>(count);
    return w;
  };
  const Side one = side(pair, false), two = side(pair, true);
  const Whole a = whole(one), b = whole(two);
  // In one place, each pair of many goes another way.
  const auto spread = [](Index i) { return glm::fract(float(i + 1) * glm::vec3(0.8191725f, 0.6710436f, 0.5497005f)); };
  const glm::vec3 axis = unit(a.centre - b.centre, spread(pair.range.a) - spread(pair.range.b));
  const float missing = float(law::max_separation_speed) - glm::dot(a.velocity - b.velocity, axis);
  if (missing <= 0) return;
  const float impulse = missing / (a.inverse_mass + b.inverse_mass);
  pair.work += double(impulse * (float(law::max_separation_speed) - 0.5f * missing));
  for (Index i = 0; i < one.surface->vertex_count(); ++i)
    add(v, one.slot + i * one.stride, impulse * a.inverse_mass * axis);
  for (Index i = 0; i < two.surface->vertex_count(); ++i)
    add(v, two.slot + i * two.stride, -impulse * b.inverse_mass * axis);
}

bool SurfaceContact::needs_more_iterations(float h) const {
  return std::any_of(pairs_.begin(), pairs_.end(), [&](const Pair& p) { return needs_more_iterations(p, h); });
}

/// visit(pair, its rows): colour by colour, each by one thread. A few rows are done by the first thread before all have
/// met at every colour; the others do not wait for it.
template <class Visit>
void SurfaceContact::for_each_pair(int thread, int threads, const std::function<void()>& barrier, const Visit& visit) {
  const bool alone = few_rows();
  for (const auto& colour : colours_) {
    const collide::Part part =
        alone ? collide::Part{0, thread == 0 ? colour.size() : 0} : collide::part_of(colour.size(), thread, threads);
    for (std::size_t i = part.begin; i < part.end; ++i) {
      Pair& p = pairs_[colour[i]];
      visit(p, std::span(thread_work_[static_cast<std::size_t>(p.thread)].rows).subspan(p.first_row, p.rows));
    }
    if (!alone) barrier();
  }
}

void SurfaceContact::solve(int thread, int threads, Field<const float> x, Field<float> v, float h,
                           const std::function<void()>& barrier) {
  const auto pass = [&](const auto& takes_part, const auto& visit, bool separating = false) {
    for_each_pair(thread, threads, barrier, [&](Pair& p, std::span<ContactRow> rows) {
      if (!takes_part(p)) return;
      if (separating && p.separating) separate(p, x, v);
      for (ContactRow& row : rows) visit(p, row);
    });
  };
  const auto all = [](const Pair&) { return true; };
  pass(all, [&](Pair&, ContactRow& row) {
    if (row.normal_impulse > 0) apply(row, row.normal_impulse * row.normal + row.friction_impulse, v);
  });
  const auto round = [&](Pair&, ContactRow& row) { solve_row(row, v); };
  if (needs_more_iterations(h))
    for (int i = iterations; i < max_iterations; ++i)
      pass([&](const Pair& p) { return needs_more_iterations(p, h); }, round, true);
  for (int i = 1; i < iterations; ++i) pass(all, round, true);
  pass(
      all,
      [&](Pair& pair, ContactRow& row) {
        pair.work += double(solve_row(row, v));
        if (row.feature == uncached) return;
        cached_[row.feature].normal_impulse = row.normal_impulse;
        cached_[row.feature].friction_impulse = row.friction_impulse;
      },
      true);
  if (thread == 0) last_h_ = h;
  if (few_rows()) barrier();
}

/// Whether a contact uses up of the distance what it has to leave.
bool SurfaceContact::violates_target(const Pair& pair, Field<const float> v, float h) const {
  constexpr float hair = 0.02f;  // of the distance
  const auto& rows = thread_work_[static_cast<std::size_t>(pair.thread)].rows;
  const auto first = rows.begin() + pair.first_row;
  return std::any_of(first, first + pair.rows, [&](const ContactRow& row) {
    return h * (row.target - glm::dot(relative_velocity(row, v), row.normal)) > hair * pair.distance;
  });
}

bool SurfaceContact::resolve_after_solids(int thread, int threads, Field<float> v, float h,
                                          const std::function<void()>& barrier) {
  bool& mine = thread_work_[static_cast<std::size_t>(thread)].violated;
  mine = false;
  for_each_pair(thread, threads, barrier, [&](Pair& p, std::span<ContactRow> rows) {
    if (!needs_more_iterations(p, h) || !violates_target(p, v, h)) return;
    mine = true;
    for (ContactRow& row : rows) {
      const float before = row.normal_impulse, work = solve_row(row, v);
      if (work > 0) p.work += double(work * (1 - before / row.normal_impulse));  // of what is new
    }
  });
  if (few_rows()) barrier();
  return std::any_of(thread_work_.begin(), thread_work_.begin() + threads,
                     [](const ThreadWork& t) { return t.violated; });
}

double SurfaceContact::work_of_substep(float h) const {
  auto work = double(search_.features().size());
  for (const Pair& p : pairs_) {
    const Index whole =
        p.separating ? side(p, false).surface->vertex_count() + side(p, true).surface->vertex_count() : 0;
    const int solves = needs_more_iterations(p, h) ? max_iterations : iterations,
              extra_passes = needs_more_iterations(p, h) ? max_passes : 0;
    work += 0.5 * (double(solves) * double(p.rows + whole) + double(extra_passes) * p.rows);
  }
  return work;
}

}  // namespace softbody
