#include "softbody/integrate/implicit/step_contacts.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

#include "softbody/contact/law.h"
#include "softbody/contact/solid_shapes.h"
#include "softbody/integrate/implicit/planes.h"

namespace softbody {
namespace {

/// Returns the surface of a solid as seen from x, in the coordinates of the body in a lane.
SurfaceAt<double> surface_from(const SolidArguments& s, std::size_t lane, const glm::dvec3& x) {
  const glm::dvec3 from = x - glm::dvec3(s.place[lane]);
  const simd::Vec<double> d{from.x, from.y, from.z};
  return simd::surface_at(s.shape, d);
}

/// Returns the point that a row keeps off a solid, in a lane of a step.
BodyPoint point_of(const ContactRow& row, int width, std::size_t lane) {
  BodyPoint point;
  for (std::size_t k = 0; k < 3; ++k) {
    point.at[k] = row.slot[k] / std::size_t(width) * implicit_lanes + lane;
    point.weight[k] = double(row.weight[k]);
    assert(point.weight[k] == 0 || row.slot[k] % std::size_t(width) == row.slot[0] % std::size_t(width));
  }
  return point;
}

/// Returns true for contacts of one point with one solid, which faces that share an edge have in common. The search for
/// forces converges slowly where two differ by rounding.
bool is_same(const PlaneContact& a, const PlaneContact& b) {
  constexpr double rounding = 1e-5;
  const auto weight_in = [](const BodyPoint& point, std::size_t at) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += point.at[k] == at ? point.weight[k] : 0;
    return sum;
  };
  double apart = glm::distance(a.normal, b.normal);
  for (const std::size_t at : a.point.at) apart += std::abs(weight_in(a.point, at) - weight_in(b.point, at));
  return apart < rounding;
}

}  // namespace

LaneMask find_planes(const ImplicitBatch& b, const MovingAxes& axes, ImplicitBodies& bodies) {
  LaneMask in_contact;
  bodies.planes.clear();
  const auto add_plane = [&](const PlaneContact& c) {
    constexpr double least = 0.1;  // share of corners that are free; with less of it they would be moved far
    if (c.point.mean([&](std::size_t at) { return is_held(bodies, at) ? 0.0 : 1.0; }) < least) return;
    const glm::dvec3 meant = c.point.mean(
        [&](std::size_t at) { return axes.free_displacement(c.point.lane(), read(bodies.x, at), read(bodies.v, at)); });
    if (glm::dot(meant, c.normal) < c.min_displacement) in_contact.set(c.point.lane());
    bodies.planes.push_back(c);
  };
  for (std::size_t lane = 0; lane < implicit_lanes; ++lane) {
    if (!axes.active()[lane]) continue;
    const std::size_t own = b.first_lane + lane;  // in the batch
    for (const SolidArguments& s : b.near_solids) {
      if (!(s.near >> own & 1u)) continue;
      for (std::size_t at = lane; at < bodies.x.size() / 3; at += implicit_lanes) {
        const SurfaceAt<double> surface = surface_from(s, own, read(bodies.x, at));
        const glm::dvec3 normal(surface.normal.x, surface.normal.y, surface.normal.z);
        add_plane(
            {{{at}}, double(s.friction), double(s.restitution), normal, law::min_move(surface.distance, axes.step())});
      }
    }
    const std::size_t first = bodies.planes.size();
    for (const ContactRow& row : b.features) {
      if (row.slot[0] % std::size_t(b.batch.width) != own) continue;
      const PlaneContact c{point_of(row, b.batch.width, lane), double(row.friction), double(row.restitution),
                           glm::dvec3(row.normal), double(row.target) * axes.step()};
      if (std::ranges::none_of(std::span(bodies.planes).subspan(first),
                               [&](const PlaneContact& other) { return is_same(c, other); }))
        add_plane(c);
    }
  }
  return in_contact;
}

LaneMask find_penalty_pairs(const ImplicitBatch& b, LaneMask moving, double h, ImplicitBodies& bodies) {
  LaneMask in_contact;
  bodies.penalty_pairs.clear();
  const auto velocity = [&](std::size_t slot) { return glm::dvec3(read(b.v, slot)); };
  for (const PenaltyEnd& end : b.ends) {
    const PenaltyPairs& pairs = b.penalty.pairs();
    const std::uint32_t i = end.pair;
    const auto [slot, other_slot] =
        end.at_b ? std::pair(pairs.slot_b[i], pairs.slot_a[i]) : std::pair(pairs.slot_a[i], pairs.slot_b[i]);
    const auto place = b.place(slot);
    if (!place || !moving[*place % implicit_lanes]) continue;
    const std::size_t at = *place;
    const PenaltyContact::Slopes slopes = b.penalty.slopes(i, b.x, b.v, float(h));
    if (slopes.spring <= 0) continue;
    LinearPenaltyPair s{.end = end,
                        .at = at,
                        .normal = double(end.sign()) * glm::dvec3(read(field(pairs.normal), i)),
                        .slopes = slopes};
    s.force = b.penalty.force(end);
    s.friction = double(pairs.friction[i]);
    if (b.is_moving(end.at_b ? pairs.body_a[i] : pairs.body_b[i])) {
      s.partner = h * velocity(other_slot);
      s.share = 0.5;
    }
    s.start_separation = h * velocity(slot) - s.partner;
    s.max_work = b.penalty.max_work(i, b.x, glm::length(s.partner));
    bodies.penalty_pairs.push_back(s);
    in_contact.set(at % implicit_lanes);
  }
  return in_contact;
}

}  // namespace softbody
