// SolidContact: faces and edges of bodies on solids that are round or sharp.

#include <algorithm>
#include <optional>
#include <utility>

#include "softbody/contact/solid_contact.h"
#include "softbody/contact/solid_law.h"
#include "softbody/contact/solid_shapes.h"
#include "softbody/contact/surface_vectors.h"

namespace softbody {
namespace {

/// Returns true if the ball round the corners comes within that distance (m) of the core.
bool may_meet(std::span<const glm::vec3> corners, const glm::vec3& from, const glm::vec3& to, float max_distance) {
  glm::vec3 middle(0.0f);
  for (const glm::vec3& c : corners) middle += c / float(corners.size());
  float radius = 0;
  for (const glm::vec3& c : corners) radius = std::max(radius, glm::length(c - middle));
  const glm::vec3 along = to - from;
  const float square = glm::dot(along, along);
  const float t = square > 0 ? std::clamp(glm::dot(middle - from, along) / square, 0.0f, 1.0f) : 0.0f;
  return glm::length(middle - from - t * along) <= radius + max_distance;
}

/// Where a body's face and a solid's point, or two edges, are closest to each other.
struct ClosestPoints {
  std::array<float, 3> weight{};  // of the body's corners
  glm::vec3 point{0.0f};          // m, on the body
  glm::vec3 apart;                // m, from the core to it
  glm::vec3 across;               // normal to both, of either sign and any length
  bool inner;                     // on the border of neither
};

/// Returns those of pair i of `meeting`.
ClosestPoints closest_points(const NearCore& core, const collide::surface::FeatureBatch& meeting, Index i) {
  const bool face = core.corners == 3;
  const std::size_t first = face ? 1 : 0;
  const collide::surface::Closest c = face ? meeting.closest_vertex_face(i) : meeting.closest_edges(i);
  ClosestPoints m{.apart = face ? -c.separation : c.separation, .across = {}, .inner = c.inner};
  std::array<glm::vec3, 3> x{};
  for (std::size_t k = 0; k < core.corners; ++k) {
    x[k] = meeting.corner(first + k, i);
    m.weight[k] = c.weight[first + k];
    m.point += m.weight[k] * x[k];
  }
  m.across = face ? normal_of(x[0], x[1], x[2]) : glm::cross(x[1] - x[0], core.to - core.from);
  return m;
}

/// Returns the unit normal of both, if it points away from all of a box's sides that meet in the core: else other
/// features tell which side the body is on.
std::optional<glm::vec3> outward_normal(const NearCore& f, const ClosestPoints& m, const BoxShape<float>& box) {
  const float length = glm::length(m.across);
  if (!m.inner || !(length > 0)) return std::nullopt;
  const glm::vec3 n = (glm::dot(m.across, f.out) < 0 ? -1 / length : 1 / length) * m.across;
  for (const glm::vec3& axis : box.axes)
    if (glm::dot(n, axis) * glm::dot(f.out, axis) < 0) return std::nullopt;
  return n;
}

/// Returns how far apart the two are. A round solid has the core inside, and is seen as particles see it. A box has it
/// on its surface: a point inside the box has crossed along the normal of both, and leaves on the near side. All others
/// are outside, as far away as the core is, also those beyond the far side of a thin box. Returns nothing where it
/// cannot be told.
std::optional<SurfaceAt<float>> gap_of(const NearCore& f, const ClosestPoints& m, const SolidShape<float>& shape,
                                       const glm::vec3& place) {
  const glm::vec3 at = m.point - place;
  const simd::Vec<float> d{at.x, at.y, at.z};
  const auto* box = std::get_if<BoxShape<float>>(&shape);
  if (!box) return simd::surface_at(shape, d);
  constexpr float rounding = 1e-6f;  // m
  const bool inside = simd::surface_at(*box, d).distance + box->radius <= rounding;
  if (const auto n = outward_normal(f, m, *box)) {
    const float apart = glm::dot(m.apart, *n);
    if (apart >= 0 || (inside && glm::dot(*n, at) >= 0))
      return SurfaceAt<float>{apart - box->radius, {n->x, n->y, n->z}};
  }
  const float apart = glm::length(m.apart);
  if (inside || !(apart > 0)) return std::nullopt;
  const glm::vec3 n = m.apart / apart;
  return SurfaceAt<float>{apart - box->radius, {n.x, n.y, n.z}};
}

}  // namespace

/// Finds the features of the body in a lane, in that extent, that may come to the cores if the body goes `travel` (m)
/// in `seconds`.
void SolidContact::find_features(const Batch& b, const Extent& e, int lane, const SolidInterior& interior,
                                 double travel, double seconds) {
  OfBatch& own = of_batch_[b.index];
  const glm::dvec3 origin = state_.body(b.body[std::size_t(lane)]).origin;
  const Field<const float> x = field(std::as_const(state_.x), b.base);
  const auto position = [&](std::uint32_t v) {
    return read(x, std::size_t(v) * std::size_t(b.width) + std::size_t(lane));
  };
  const collide::surface::Surface& surface = *b.model->surface;
  const std::array box{e.lo[std::size_t(lane)], e.hi[std::size_t(lane)]};
  const double distance = interior.core_radius + b.model->material[Material::thickness];
  for (const SolidCore& core : interior.cores) {
    NearCore found{lane,
                   own.near.size() - 1,
                   glm::vec3(core.from - origin),
                   glm::vec3(core.to - origin),
                   glm::vec3(core.out),
                   float(distance),
                   float(travel / seconds),
                   core.point() ? std::size_t{3} : 2};
    if (!may_meet(box, found.from, found.to, float(distance + travel))) continue;
    const auto add = [&](const auto& features) {
      for (const auto& feature : features) {
        std::array<glm::vec3, 3> corners{};
        std::transform(feature.begin(), feature.end(), corners.begin(), position);
        if (!may_meet(std::span(corners).first(feature.size()), found.from, found.to, float(distance + travel)))
          continue;
        std::copy(feature.begin(), feature.end(), found.features.emplace_back().vertices.begin());
      }
    };
    core.point() ? add(surface.triangles()) : add(surface.edges());
    if (!found.features.empty()) own.cores.push_back(std::move(found));
  }
}

std::span<ContactRow> SolidContact::find_feature_rows(const Batch& b, float h, std::span<const double> speeds) {
  if (!meets_features(b)) return {};
  OfBatch& own = of_batch_[b.index];
  own.rows.clear();
  const Field<const float> x = field(std::as_const(state_.x), b.base);
  collide::surface::FeatureBatch meeting;
  for (NearCore& core : own.cores) {
    const auto lane = std::size_t(core.lane);
    const auto at = [&](std::uint32_t v) { return read(x, v * std::size_t(b.width) + lane); };
    core.start = core.end;
    // Only of a sphere the core tells how near a feature is. Others are met, too, where they are far from one core.
    const bool foreseen = speeds.empty() || !std::holds_alternative<SphereShape<float>>(own.near[core.solid].shape);
    core.end += 2 * h * (foreseen ? core.speed : float(speeds[lane]));  // twice: contacts may push one particle further
    for (Index i = 0; i < core.features.size(); ++i) {
      if (core.features[i].free_until > core.end) continue;
      const auto& [p, q, r] = core.features[i].vertices;
      if (core.corners == 3)
        meeting.add({core.from, at(p), at(q), at(r)}, i);
      else
        meeting.add({at(p), at(q), core.from, core.to}, i);
      if (meeting.full()) add_rows(b, core, meeting, h);
    }
    add_rows(b, core, meeting, h);
  }
  return own.rows;
}

/// Solves the rows of the features that may meet a solid in turn with the particles, a few times: what one pushes too
/// far because of another is taken back.
void SolidContact::apply_to_features(const Batch& b, float h) {
  constexpr int passes = 3;
  OfBatch& own = of_batch_[b.index];
  if (!meets_features(b)) return;
  std::array<double, lanes> speeds = state_.max_particle_speeds(b);
  for (double& speed : speeds) speed += law::max_separation_speed;
  const std::span<ContactRow> rows = find_feature_rows(b, h, speeds);
  const Field<float> v = field(state_.v, b.base);
  const auto acted = [](const ContactRow& row) { return row.normal_impulse > 0; };
  for (int pass = 0; pass < passes; ++pass) {
    for (ContactRow& row : rows) solve_row(row, v);
    if (!std::ranges::any_of(rows, acted)) return;
    apply_to_particles(b, h, true);
    state_.held.impose(b, field(state_.v));
  }
  for (const ContactRow& row : rows) {
    if (!acted(row)) continue;
    const auto lane = std::size_t(own.cores[row.feature].lane);
    own.book(row, lane);
    own.energy[lane] += work_of_holders(row, v);
  }
}

/// Adds the rows of features: by the law of the particles' contacts, for the closest points, whose corners share an
/// impulse by their weights. Empties `meeting`.
void SolidContact::add_rows(const Batch& b, NearCore& core, collide::surface::FeatureBatch& meeting, float h) {
  OfBatch& own = of_batch_[b.index];
  constexpr float on_vertex = 0.999f;  // a weight from which on the vertex itself keeps off
  const auto lane = std::size_t(core.lane);
  const SolidArguments& s = own.near[core.solid];
  const std::span<const char> held = state_.held.of(b.body[lane]);
  core.corners == 3 ? meeting.find_closest_vertex_faces() : meeting.find_closest_edges();
  for (Index i = 0; i < meeting.size(); ++i) {
    SolidFeature& f = core.features[meeting.tag(i)];
    const ClosestPoints m = closest_points(core, meeting, i);
    f.free_until = core.start + (glm::length(m.apart) - core.distance);
    if (f.free_until > core.end || *std::ranges::max_element(m.weight) > on_vertex) continue;
    const auto surface = gap_of(core, m, s.shape, s.place[lane]);
    if (!surface) continue;

    ContactRow row{};
    row.slot.fill(std::uint32_t(f.vertices[0] * std::size_t(b.width) + lane));
    float mobility = 0;
    for (std::size_t k = 0; k < core.corners; ++k) {
      row.slot[k] = std::uint32_t(f.vertices[k] * std::size_t(b.width) + lane);
      row.weight[k] = m.weight[k];
      row.mobility[k] = !held.empty() && held[f.vertices[k]] ? held_mobility : m.weight[k] / s.mass;
      mobility += row.weight[k] * row.mobility[k];
    }
    if (mobility <= least_mobility) continue;
    row.mass = 1 / mobility;
    row.normal = {surface->normal.x, surface->normal.y, surface->normal.z};
    row.friction = s.friction;
    row.target = law::min_speed(surface->distance, 1 / h);
    row.push = std::max(0.0f, row.target);
    row.before =
        s.restitution > 0 ? glm::dot(relative_velocity(row, field(std::as_const(before_), b.base)), row.normal) : 0;
    row.restitution = s.restitution;
    row.feature = std::uint32_t(&core - own.cores.data());
    own.rows.push_back(row);
  }
  meeting.clear();
}

}  // namespace softbody
