#include "softbody/integrate/implicit/contact_search.h"

#include <glm/geometric.hpp>

#include "softbody/contact/law.h"
#include "softbody/contact/solid_shapes.h"

namespace softbody {
LaneMask find_planes(const ImplicitBatch& b, const ImplicitFrames& frames, LaneMask moving, double h,
                     ImplicitWork& work) {
  LaneMask in_contact;
  work.planes.clear();
  for (std::size_t lane = 0; lane < implicit_lanes; ++lane) {
    if (!moving[lane]) continue;
    const std::size_t own = b.first_lane + lane;  // in the batch
    for (const SolidArguments& s : b.near_solids) {
      if (!(s.near >> own & 1u)) continue;
      for (std::size_t at = lane; at < work.x.size() / 3; at += implicit_lanes) {
        const glm::dvec3 x = read(work.x, at), v = read(work.v, at);
        const glm::dvec3 d = x - glm::dvec3(s.place[own]);
        const SurfaceAt<double> surface = body::surface_at(s.shape, body::Vec<double>{d.x, d.y, d.z});
        const glm::dvec3 normal(surface.normal.x, surface.normal.y, surface.normal.z);
        const double out = law::min_move(surface.distance, h);
        if (glm::dot(frames.free_displacement(lane, x, v), normal) < out) in_contact.set(lane);
        work.planes.push_back({at, double(s.friction), double(s.restitution), normal, out});
      }
    }
  }
  return in_contact;
}

LaneMask find_penalty_pairs(const ImplicitBatch& b, LaneMask moving, double h, ImplicitWork& work) {
  LaneMask in_contact;
  work.penalty_pairs.clear();
  const auto velocity = [&](std::size_t slot) { return glm::dvec3(read(b.v, slot)); };
  for (const PenaltyEnd& end : b.ends) {
    const PenaltyPair pair = b.penalty.pairs[end.pair];
    const auto [slot, other_slot] =
        end.at_b ? std::pair(pair.slot_b, pair.slot_a) : std::pair(pair.slot_a, pair.slot_b);
    const std::size_t in_batch = slot - b.base, lane = in_batch % std::size_t(b.width) - b.first_lane;
    if (lane >= implicit_lanes || !moving[lane]) continue;
    const std::size_t at = in_batch / std::size_t(b.width) * implicit_lanes + lane;
    const PenaltyContact::Slopes slopes = b.penalty.slopes(pair, b.x, b.v, float(h));
    if (slopes.spring <= 0) continue;
    LinearPenaltyPair s{.at = at, .normal = double(end.sign()) * glm::dvec3(pair.normal), .slopes = slopes};
    s.force = double(end.sign()) * glm::dvec3(b.penalty.force[end.pair]);
    s.friction = double(pair.friction);
    s.partner = b.is_moving(end.at_b ? pair.body_a : pair.body_b) ? h * velocity(other_slot) : glm::dvec3(0.0);
    s.start_separation = h * velocity(slot) - s.partner;
    s.max_work = b.penalty.max_work(pair, b.x, glm::length(s.partner));
    work.penalty_pairs.push_back(s);
    in_contact.set(lane);
  }
  return in_contact;
}

}  // namespace softbody
