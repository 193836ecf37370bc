#include "softbody/contact/solid_contact.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

#include "softbody/contact/kernels.h"
#include "softbody/contact/keys.h"
#include "softbody/contact/law.h"
#include "softbody/contact/solid_law.h"
#include "softbody/contact/solid_overlap.h"
#include "softbody/contact/solid_shapes.h"
#include "softbody/state/kernels.h"

namespace softbody {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Returns how far (m) the body in a lane may come within `seconds`: twice as far as its fastest particle goes now, and
/// a tenth of its radius.
double max_travel(const Batch& b, const Extent& e, int lane, const glm::dvec3& gravity, double seconds) {
  const double fall = glm::length(gravity) * seconds;
  return (2 * std::sqrt(double(e.length2[lane])) + fall) * seconds + 0.1 * b.model->radius +
         b.model->material[Material::thickness];
}

/// Returns the unit vector along which a box leaves a solid soonest, without going deeper into another one: one of the
/// scene's axes, or away from where the solid's surface is nearest.
glm::dvec3 way_out(std::span<const Solid> solids, const Solid& solid, const PlacedBox& box) {
  const glm::dvec3 nearest = surface_at(solid, box.centre).normal;
  const double size = glm::length(box.half_size);
  glm::dvec3 best = nearest;
  double shortest = infinite;
  const auto consider = [&](const glm::dvec3& way) {
    PlacedBox at = box;
    constexpr int steps = 100;
    double length = 0;
    for (int i = 0; i < steps && gap_before(solid, at) < 0; ++i) {
      length += std::max(-gap_before(solid, at), 0.05 * size);
      at.centre = box.centre + length * way;
    }
    const bool free =
        length < shortest && gap_before(solid, at) >= 0 && std::ranges::all_of(solids, [&](const Solid& other) {
          const double now = gap_before(other, at);
          return now >= 0 || now >= gap_before(other, box);
        });
    if (!free) return;
    best = way;
    shortest = length;
  };
  consider(nearest);
  for (const glm::dvec3& way : {glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1)})
    for (const double sign : {1.0, -1.0}) consider(sign * way);
  return best;
}

}  // namespace

bool SolidContact::lies_in(const Batch& b, int lane, const Solid& solid) const {
  std::array<std::vector<float>, 3> at;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < b.particles(); ++i)
      at[k].push_back(state_.x[k][b.base + i * std::size_t(b.width) + std::size_t(lane)]);
  const collide::VertexRun run{at[0].data(), at[1].data(), at[2].data(), Index(b.particles())};
  return overlap({*b.model->surface, state_.body(b.body[std::size_t(lane)]).origin, run, b.model->mean_edge}, solid,
                 has_features_);
}

/// Gives a body the velocity with which it goes that way in a frame, and not aside. It keeps what its particles do
/// beside that. The impulse counts as one of the solid.
void SolidContact::ease_out(const Batch& b, int lane, const glm::dvec3& way, const glm::dvec3& gravity,
                            double seconds) {
  const BodyField v = state_.field_of(b.body[std::size_t(lane)], state_.v);
  glm::dvec3 mean(0.0);
  for (std::size_t i = 0; i < b.particles(); ++i) mean += v(i) / double(b.particles());
  const glm::vec3 change(law::max_separation_speed * way - 0.5 * seconds * gravity - mean);
  for (std::size_t i = 0; i < b.particles(); ++i) v.add(i, glm::dvec3(change));
  const glm::dvec3 given = double(b.particles()) * b.model->particle_mass * glm::dvec3(change);  // N s
  BodyField{sums(b).impulse, std::size_t(lane), 1}.add(0, given);
  state_.ledger.book(WorkBy::easing, glm::dot(given, mean + 0.5 * glm::dvec3(change)));
  of_batch_[b.index].pushed |= 1u << lane;
  state_.memory(b.body[std::size_t(lane)]).calm_frames = 0;
}

void SolidContact::begin_frame() {
  of_batch_.resize(state_.batches().size());
  for (OfBatch& b : of_batch_) b = {};
  pushes_.clear();
  if (has_restitution_) before_ = state_.v;
}

void SolidContact::add(const Batch& b, const Extent& e, std::span<const Solid> solids, const glm::dvec3& gravity,
                       double seconds) {
  std::array<PlacedBox, lanes> boxes;
  std::array<double, lanes> travel;
  for (std::size_t l = 0; l < std::size_t(b.used); ++l) {
    const glm::dvec3 lo(e.lo[l]), hi(e.hi[l]);
    boxes[l] = {state_.body(b.body[l]).origin + 0.5 * (lo + hi), 0.5 * (hi - lo)};
    travel[l] = max_travel(b, e, int(l), gravity, seconds);
  }
  for (const Solid& solid : solids) {
    if (!solid.enabled) continue;
    std::array<double, lanes> gap;
    unsigned lanes_near = 0;
    for (std::size_t l = 0; l < std::size_t(b.used); ++l) {
      gap[l] = gap_before(solid, boxes[l]);
      lanes_near |= unsigned(gap[l] <= travel[l]) << l;
    }
    if (!lanes_near) continue;
    const SolidInterior interior = interior_of(solid);
    const double deep = std::min(shallow * b.model->mean_edge, interior.middle ? interior.middle->depth : infinite);
    for (std::size_t l = 0; l < std::size_t(b.used); ++l) {
      if (b.moves[l] == 0 || !state_.body(b.body[l]).memory.may_lie_in_solid || gap[l] > -deep ||
          !lies_in(b, int(l), solid))
        continue;
      lanes_near &= ~(1u << l);
      of_batch_[b.index].eased |= 1u << l;
      ease_out(b, int(l), way_out(solids, solid, boxes[l]), gravity, seconds);
    }
    const SolidArguments& s = add(b, solid, lanes_near);
    for (std::size_t l = 0; has_features_ && l < std::size_t(b.used); ++l)
      if (b.moves[l] != 0 && s.near >> l & 1u) find_features(b, e, int(l), interior, travel[l], seconds);
  }
}

const SolidArguments& SolidContact::add(const Batch& b, const Solid& solid, unsigned lanes_near) {
  const double thickness = b.model->material[Material::thickness];
  SolidArguments& s = of_batch_[b.index].near.emplace_back();
  s.particles = b.particles();
  s.mass = float(b.model->particle_mass);
  s.friction = float(solid.friction);
  s.restitution = float(law::common_restitution(solid.restitution, b.model->material[contact::restitution]));
  for (int l = 0; l < b.used; ++l) {
    const glm::dvec3 origin = state_.body(b.body[std::size_t(l)]).origin;
    const auto put = [&](const auto& one) {
      const auto [shape, place] = placed<float>(one, thickness, origin);
      s.shape = shape;
      s.place.set(std::size_t(l), glm::vec3(place - origin));
    };
    std::visit(put, solid.shape);
  }
  s.near = lanes_near;
  s.moves = b.moves.data();
  s.sums = sums(b);
  return s;
}

void SolidContact::end_frame() {
  pushes_.assign(state_.body_count(), {});
  for (const Batch& b : state_.batches()) {
    const OfBatch& own = of_batch_[b.index];
    for (std::size_t l = 0; l < std::size_t(b.used); ++l) {
      float most = 0;
      for (const SolidArguments& s : own.near)
        if (s.near >> l & 1u) most = std::max(most, s.restitution);
      pushes_[b.body[l]] = {glm::dvec3(own.impulse[l]), double(most), double(own.returned[l])};
      state_.ledger.book(WorkBy::solids, double(own.energy[l]));
      if (b.moves[l] != 0) state_.memory(b.body[l]).may_lie_in_solid = own.eased >> l & 1u;
    }
  }
}

void SolidContact::remove(BodyId body) {
  if (body < pushes_.size()) pushes_.erase(pushes_.begin() + std::ptrdiff_t(body));
}

void SolidContact::note_velocities(const Batch& b) {
  if (!has_restitution_) return;
  state_kernels(b.width).copy(std::size_t(b.used), b.particles(), b.moves.data(), field(state_.v, b.base),
                              field(before_, b.base));
}

/// Particles first, then what lies between them, which may push particles back.
void SolidContact::apply(const Batch& b, float h) {
  const bool near = apply_to_particles(b, h, false);
  state_.held.impose(b, field(state_.v));
  if (near) apply_to_features(b, h);
}

/// Applies each solid in turn. Where two act on one body the later may push a particle into the earlier, as in a
/// groove: they take turns until what is left is slow, or for so long (Gauss and Seidel). Returns false if no solid is
/// near.
bool SolidContact::apply_to_particles(const Batch& b, float h, bool again) {
  assert(b.index < of_batch_.size() && h > 0);  // after begin_frame()
  constexpr int max_passes = 8;
  constexpr float slack = 1e-4f;  // m/s
  OfBatch& own = of_batch_[b.index];
  unsigned acted = again ? ~0u : 0;
  for (int pass = 0; pass < max_passes; ++pass) {
    bool more = false;
    for (SolidArguments& s : own.near) {
      s.h = h;
      s.slack = pass || again ? slack : 0;
      if (has_restitution_) s.before = field(std::as_const(pass || again ? state_.v : before_), b.base);
      const unsigned now = act_by_solid(b.width, std::size_t(b.used), s, field(std::as_const(state_.x), b.base),
                                        field(state_.v, b.base));
      more = more || (acted & now) || (pass && now);
      acted |= now;
      own.pushed |= now;
    }
    if (!more) break;
  }
  return !own.near.empty();
}

void SolidContact::add_particle_rows(BodyId body, float travel, std::vector<ContactRow>& rows) const {
  const Batch& b = state_.batch_of(body);
  const auto lane = std::size_t(state_.body(body).lane);
  const std::vector<SolidArguments>& near = of_batch_[b.index].near;
  const std::span<const char> held = state_.held.of(body);
  for (std::uint32_t i = 0; i < near.size(); ++i) {
    const SolidArguments& s = near[i];
    if (!(s.near >> lane & 1u) || s.moves[lane] == 0) continue;
    const glm::vec3 place(s.place.x[lane], s.place.y[lane], s.place.z[lane]);
    for (Index v = 0; v < b.particles(); ++v) {
      if (!held.empty() && held[v]) continue;
      const auto slot = std::uint32_t(state_.slot(body, v));
      const glm::vec3 at = read(field(std::as_const(state_.x)), slot) - place;
      const SurfaceAt<float> surface = simd::surface_at(s.shape, simd::Vec<float>{at.x, at.y, at.z});
      if (surface.distance > travel) continue;
      ContactRow& row = rows.emplace_back();
      row.slot.fill(slot);
      row.weight[0] = 1;
      row.mobility[0] = 1 / s.mass;
      row.mass = s.mass;
      row.normal = {surface.normal.x, surface.normal.y, surface.normal.z};
      row.friction = s.friction;
      row.target = law::min_speed(surface.distance, 1 / s.h);
      row.push = std::max(0.0f, row.target);
      row.before = has_restitution_ ? glm::dot(read(field(std::as_const(before_)), slot), row.normal) : 0;
      row.restitution = s.restitution;
      row.slack = infinite;  // what is left they do by themselves
      row.feature = i;
    }
  }
}

void SolidContact::book(BodyId body, std::span<const ContactRow> rows) {
  const Batch& b = state_.batch_of(body);
  const auto lane = std::size_t(state_.body(body).lane);
  for (const ContactRow& row : rows)
    if (row.normal_impulse > 0) of_batch_[b.index].book(row, lane);
}

}  // namespace softbody
