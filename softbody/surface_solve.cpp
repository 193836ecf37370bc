// Surface contact: the impulses of a substep.

#include <algorithm>

#include "softbody/surface_vectors.h"

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
  glm::vec3 drag = row.drag - row.mass * slip;
  if (const float size = glm::length(drag), limit = row.friction * pressed; size > limit) drag *= limit / size;
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
      w.centre += (read(x, s.slot + i * lanes) + s.offset) / static_cast<float>(count);
      w.velocity += read(v, s.slot + i * lanes) / static_cast<float>(count);
    }
    w.inverse_mass = s.inverse_mass / static_cast<float>(count);
    return w;
  };
  const Side one = side(pair, false), two = side(pair, true);
  const Whole a = whole(one), b = whole(two);
  const glm::vec3 axis = unit(a.centre - b.centre, {});
  const float missing = push_speed - glm::dot(a.velocity - b.velocity, axis);
  if (missing <= 0) return;
  const float impulse = missing / (a.inverse_mass + b.inverse_mass);
  for (Index i = 0; i < one.surface->vertex_count(); ++i) add(v, one.slot + i * lanes, impulse * a.inverse_mass * axis);
  for (Index i = 0; i < two.surface->vertex_count(); ++i)
    add(v, two.slot + i * lanes, -impulse * b.inverse_mass * axis);
}

void SurfaceContact::solve(int thread, int threads, Field<const float> x, Field<float> v, float h,
                           const std::function<void()>& barrier, const std::function<void()>& solids) {
  constexpr std::size_t few = 2000;  // rows: done before the threads have met at every colour
  const bool alone = rows() < few;
  const auto hit = [&](const Pair& p) { return h * p.rate > 0.5f; };
  const auto pass = [&](const auto& takes_part, const auto& visit, bool parting = false) {
    for (const auto& colour : colours_) {
      const collide::Part part =
          alone ? collide::Part{0, thread == 0 ? colour.size() : 0} : collide::part_of(colour.size(), thread, threads);
      for (std::size_t i = part.begin; i < part.end; ++i) {
        const Pair& p = pairs_[colour[i]];
        if (!takes_part(p)) continue;
        if (parting && p.parting) separate(p, x, v);
        for (std::uint32_t r = p.first_row; r < p.first_row + p.rows; ++r)
          visit(threads_[static_cast<std::size_t>(p.thread)].rows[r]);
      }
      if (!alone) barrier();
    }
  };
  const auto all = [](const Pair&) { return true; };
  pass(all, [&](ContactRow& row) {
    if (row.pressed > 0) apply(row, row.pressed * row.normal + row.drag, v);
  });
  const auto round = [&](ContactRow& row) { iterate(row, v); };
  if (std::any_of(pairs_.begin(), pairs_.end(), hit)) {
    for (int i = iterations; i < iterations_of_hits; ++i) {
      pass(hit, round, true);
      if (alone) barrier();
      solids();
      barrier();
    }
  }
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
  if (alone) barrier();
}

}  // namespace softbody
