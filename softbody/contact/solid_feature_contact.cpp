// SolidContact: faces and edges of bodies on solids that are round or sharp.

#include <algorithm>
#include <cmath>
#include <optional>

#include "collide/surface/closest_features.h"
#include "softbody/contact/solid_contact.h"
#include "softbody/contact/surface_vectors.h"

namespace softbody {
namespace {

/// Where the balls round the two overlap.
bool may_meet(std::span<const glm::vec3> corners, const glm::vec3& from, const glm::vec3& to, float max_distance) {
  glm::vec3 middle(0.0f);
  for (const glm::vec3& c : corners) middle += c / static_cast<float>(corners.size());
  float radius = 0;
  for (const glm::vec3& c : corners) radius = std::max(radius, glm::length(c - middle));
  const glm::vec3 along = to - from;
  const float square = glm::dot(along, along);
  const float t = square > 0 ? std::clamp(glm::dot(middle - from, along) / square, 0.0f, 1.0f) : 0.0f;
  return glm::length(middle - from - t * along) <= radius + max_distance;
}

/// A body's face and a solid's point, or two edges: where they are closest to each other.
struct ClosestPoints {
  std::array<float, 3> weight{};  // of the body's corners
  glm::vec3 point{0.0f};          // m, on the body
  glm::vec3 apart;                // m, from the core to it
  glm::vec3 across;               // normal to both, of either sign and any length
  bool inner;                     // on the border of neither
};

ClosestPoints closest_points(const SolidFeature& f, std::span<const glm::vec3> x) {
  ClosestPoints m;
  const bool face = x.size() == 3;
  const collide::surface::Closest c = face ? collide::surface::closest_vertex_face(f.from, x[0], x[1], x[2])
                                           : collide::surface::closest_edges(x[0], x[1], f.from, f.to);
  std::copy_n(face ? c.weight + 1 : c.weight, x.size(), m.weight.begin());
  for (std::size_t k = 0; k < x.size(); ++k) m.point += m.weight[k] * x[k];
  m.apart = face ? -c.separation : c.separation;
  m.across = face ? normal_of(x[0], x[1], x[2]) : glm::cross(x[1] - x[0], f.to - f.from);
  m.inner = c.inner;
  return m;
}

/// How far apart the two are: as seen from a round solid, which has the core inside. A box has it on its surface, so
/// there it is along what is normal to both, also where they have crossed. Nothing where others are closer.
std::optional<SurfaceAt<float>> gap_of(const SolidFeature& f, const ClosestPoints& m, const SolidShape<float>& shape,
                                       const glm::vec3& place) {
  const auto* box = std::get_if<BoxShape<float>>(&shape);
  if (!box) {
    const glm::vec3 d = m.point - place;
    return std::visit([&](const auto& s) { return body::surface_at(s, body::Vec<float>{d.x, d.y, d.z}); }, shape);
  }
  if (!m.inner || glm::dot(m.across, m.across) == 0) return std::nullopt;
  glm::vec3 n = glm::normalize(m.across);
  if (glm::dot(n, f.out) < 0) n = -n;
  for (const body::Vec<float>& a : box->axes) {  // it points away from all of the box's sides that meet in the core
    const glm::vec3 axis(a.x, a.y, a.z);
    if (glm::dot(n, axis) * glm::dot(f.out, axis) < 0) return std::nullopt;
  }
  return SurfaceAt<float>{glm::dot(m.apart, n) - box->radius, {n.x, n.y, n.z}};
}

}  // namespace

void SolidContact::find_features(const Batch& b, int lane, std::span<const SolidCore> cores, const Approach& approach) {
  OfBatch& own = of_batch_[b.index];
  const glm::dvec3 origin = state_.body(b.body[std::size_t(lane)]).origin;
  const Field<const float> x = field(std::as_const(state_.x), b.base);
  const auto position = [&](std::uint32_t v) {
    return read(x, std::size_t(v) * std::size_t(b.width) + std::size_t(lane));
  };
  const collide::surface::Surface& surface = *b.model->surface;
  for (const SolidCore& core : cores) {
    SolidFeature found{.lane = lane,
                       .solid = own.near.size() - 1,
                       .vertices = {},
                       .from = glm::vec3(core.from - origin),
                       .to = glm::vec3(core.to - origin),
                       .out = glm::vec3(core.out),
                       .distance = float(approach.distance),
                       .speed = float(approach.speed)};
    if (!may_meet(approach.box, found.from, found.to, float(approach.distance + approach.travel))) continue;
    const auto add = [&](const auto& features) {
      for (const auto& feature : features) {
        std::array<glm::vec3, 3> corners{};
        std::transform(feature.begin(), feature.end(), corners.begin(), position);
        if (!may_meet(std::span(corners).first(feature.size()), found.from, found.to,
                      float(approach.distance + approach.travel)))
          continue;
        found.vertices.fill(SolidFeature::no_vertex);
        std::copy(feature.begin(), feature.end(), found.vertices.begin());
        own.features.push_back(found);
      }
    };
    core.point() ? add(surface.triangles()) : add(surface.edges());
  }
}

/// Applies solids to one feature after another. Returns true if any acted.
bool SolidContact::apply_to_features(const Batch& b, float h) {
  bool acted = false;
  for (SolidFeature& f : of_batch_[b.index].features) {
    f.free_travel -= f.speed * h;
    if (f.free_travel <= 0) acted = apply_to_feature(b, f) || acted;
  }
  return acted;
}

/// Applies the law of the particles' contacts to the closest point: an impulse there goes to the corners by their
/// weights.
bool SolidContact::apply_to_feature(const Batch& b, SolidFeature& f) {
  OfBatch& own = of_batch_[b.index];
  constexpr float on_vertex = 0.999f;  // a weight from which on the vertex itself keeps off
  const std::size_t corners = f.vertices[2] == SolidFeature::no_vertex ? 2 : 3, lane = std::size_t(f.lane);
  const Field<float> v = field(state_.v, b.base);
  std::array<std::size_t, 3> slot{};
  std::array<glm::vec3, 3> x{};
  for (std::size_t k = 0; k < corners; ++k) {
    slot[k] = std::size_t(f.vertices[k]) * std::size_t(b.width) + lane;
    x[k] = read(field(std::as_const(state_.x), b.base), slot[k]);
  }
  const ClosestPoints m = closest_points(f, std::span(x).first(corners));
  f.free_travel = 0.5f * (glm::length(m.apart) - f.distance);  // half: single particles may be faster than was foreseen
  if (*std::max_element(m.weight.begin(), m.weight.end()) > on_vertex) return false;
  const SolidArguments& s = own.near[f.solid];
  const auto surface = gap_of(f, m, s.shape, {s.place.x[lane], s.place.y[lane], s.place.z[lane]});
  if (!surface) return false;

  const body::Vec<float>& n = surface->normal;
  body::Vec<float> velocity{}, before{};
  float square = 0;
  for (std::size_t k = 0; k < corners; ++k) {
    const auto add_share = [&](body::Vec<float>& sum, Field<const float> of) {
      const glm::vec3 u = m.weight[k] * read(of, slot[k]);
      sum = sum + body::Vec<float>{u.x, u.y, u.z};
    };
    add_share(velocity, v);
    if (s.restitution > 0) add_share(before, s.before);
    square += m.weight[k] * m.weight[k];
  }
  body::Vec<float> after = velocity;
  const float change = body::respond(s, 1.0f, surface->distance, n, before, after);
  if (change <= 0) return false;
  const glm::vec3 gained(after.x - velocity.x, after.y - velocity.y, after.z - velocity.z);
  for (std::size_t k = 0; k < corners; ++k) softbody::add(v, slot[k], m.weight[k] / square * gained);
  const float impulse = s.mass / square * change;
  s.impulse.x[lane] += impulse * n.x, s.impulse.y[lane] += impulse * n.y, s.impulse.z[lane] += impulse * n.z;
  s.returned[lane] += s.restitution * impulse;
  own.pushed |= 1u << lane;
  return true;
}

}  // namespace softbody
