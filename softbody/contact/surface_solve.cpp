// Surface contact: the impulses of a substep.

#include <algorithm>

#include "softbody/contact/law.h"
#include "softbody/contact/surface_vectors.h"

namespace softbody {
namespace {

void apply(const ContactRow& row, const glm::vec3& impulse, Field<float> v) {
  for (std::size_t k = 0; k < 4; ++k) add(v, row.slot[k], row.mobility[k] * impulse);
}

void iterate(ContactRow& row, Field<float> v) {
  glm::vec3 velocity = relative_velocity(row, v);
  const float speed = glm::dot(velocity, row.normal);
  const float held = row.hardness / (1 + row.hardness) * (row.pressed + row.mass * (row.widening - speed));
  const float pressed = std::max({0.0f, held, row.pressed + row.mass * (row.target - speed)});
  if (pressed == 0 && row.pressed == 0) return;
  const float push = pressed - row.pressed;
  row.pressed = pressed;
  velocity += (push / row.mass) * row.normal;
  const glm::vec3 slip = velocity - glm::dot(velocity, row.normal) * row.normal;
  const glm::vec3 drag = law::within_cone(row.drag - row.mass * slip, row.friction * pressed);
  apply(row, push * row.normal + (drag - row.drag), v);
  row.drag = drag;
}

}  // namespace

/// Two bodies far inside each other move apart along the line of their centres, each as a whole: their shapes, momentum
/// and angular momentum stay.
void SurfaceContact::separate(const Pair& pair, Field<const float> x, Field<float> v) const {
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
  const glm::vec3 axis = unit(a.centre - b.centre, {});
  const float missing = float(law::max_separation_speed) - glm::dot(a.velocity - b.velocity, axis);
  if (missing <= 0) return;
  const float impulse = missing / (a.inverse_mass + b.inverse_mass);
  for (Index i = 0; i < one.surface->vertex_count(); ++i)
    add(v, one.slot + i * one.stride, impulse * a.inverse_mass * axis);
  for (Index i = 0; i < two.surface->vertex_count(); ++i)
    add(v, two.slot + i * two.stride, -impulse * b.inverse_mass * axis);
}

bool SurfaceContact::hit(float h) const {
  return std::any_of(pairs_.begin(), pairs_.end(), [&](const Pair& p) { return hit(p, h); });
}

/// visit(pair, its rows): colour by colour, each by one thread. A few rows are done by the first thread before all have
/// met at every colour; the others do not wait for it.
template <class Visit>
void SurfaceContact::each_pair(int thread, int threads, const std::function<void()>& barrier, const Visit& visit) {
  const bool alone = few_rows();
  for (const auto& colour : colours_) {
    const collide::Part part =
        alone ? collide::Part{0, thread == 0 ? colour.size() : 0} : collide::part_of(colour.size(), thread, threads);
    for (std::size_t i = part.begin; i < part.end; ++i) {
      const Pair& p = pairs_[colour[i]];
      visit(p, std::span(threads_[static_cast<std::size_t>(p.thread)].rows).subspan(p.first_row, p.rows));
    }
    if (!alone) barrier();
  }
}

void SurfaceContact::solve(int thread, int threads, Field<const float> x, Field<float> v, float h,
                           const std::function<void()>& barrier) {
  const auto pass = [&](const auto& takes_part, const auto& visit, bool parting = false) {
    each_pair(thread, threads, barrier, [&](const Pair& p, std::span<ContactRow> rows) {
      if (!takes_part(p)) return;
      if (parting && p.parting) separate(p, x, v);
      std::for_each(rows.begin(), rows.end(), visit);
    });
  };
  const auto all = [](const Pair&) { return true; };
  pass(all, [&](ContactRow& row) {
    if (row.pressed > 0) apply(row, row.pressed * row.normal + row.drag, v);
  });
  const auto round = [&](ContactRow& row) { iterate(row, v); };
  if (hit(h))
    for (int i = iterations; i < iterations_of_hits; ++i) pass([&](const Pair& p) { return hit(p, h); }, round, true);
  for (int i = 1; i < iterations; ++i) pass(all, round, true);
  pass(
      all,
      [&](ContactRow& row) {
        iterate(row, v);
        if (row.feature == forgotten) return;
        memory_[row.feature].pressed = row.pressed;
        memory_[row.feature].drag = row.drag;
      },
      true);
  if (thread == 0) last_h_ = h;
  if (few_rows()) barrier();
}

/// Whether a contact uses up of the distance what it has to leave.
bool SurfaceContact::undone(const Pair& pair, Field<const float> v, float h) const {
  constexpr float hair = 0.02f;  // of the distance
  const auto& rows = threads_[static_cast<std::size_t>(pair.thread)].rows;
  const auto first = rows.begin() + pair.first_row;
  return std::any_of(first, first + pair.rows, [&](const ContactRow& row) {
    return h * (row.target - glm::dot(relative_velocity(row, v), row.normal)) > hair * pair.distance;
  });
}

bool SurfaceContact::mend(int thread, int threads, Field<float> v, float h, const std::function<void()>& barrier) {
  bool& mine = threads_[static_cast<std::size_t>(thread)].undone;
  mine = false;
  each_pair(thread, threads, barrier, [&](const Pair& p, std::span<ContactRow> rows) {
    if (!hit(p, h) || !undone(p, v, h)) return;
    mine = true;
    for (ContactRow& row : rows) iterate(row, v);
  });
  if (few_rows()) barrier();
  return std::any_of(threads_.begin(), threads_.begin() + threads, [](const Thread& t) { return t.undone; });
}

double SurfaceContact::work_of_substep(float h) const {
  auto work = double(search_.features().size());
  for (const Pair& p : pairs_) {
    const Index whole = p.parting ? side(p, false).surface->vertex_count() + side(p, true).surface->vertex_count() : 0;
    const int solves = hit(p, h) ? iterations_of_hits : iterations, mends = hit(p, h) ? turns : 0;
    work += 0.5 * (double(solves) * double(p.rows + whole) + double(mends) * p.rows);
  }
  return work;
}

}  // namespace softbody
