#include "app/report/solid_passages.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include "app/report/worlds.h"
#include "softbody/model/body_model.h"
#include "softbody/world/measures.h"

namespace app::report {
namespace {

/// Cosine of the angle from which on two normals of a solid count as those of opposite sides: adjacent faces of a box
/// have 0.
constexpr float opposite = -0.2f;

}  // namespace

bool SolidPassages::passed(const softbody::World& world, const glm::dvec3& from, const glm::dvec3& to,
                           double radius) const {
  const int parts = 1 + int(std::min(16 * glm::distance(from, to) / radius, 4000.0));
  std::optional<glm::vec3> in;  // the solid's normal where the line went in
  softbody::SolidDepth before = softbody::solid_depth(world.scene(), from);
  for (int i = 1; i <= parts; ++i) {
    const softbody::SolidDepth at = softbody::solid_depth(world.scene(), glm::mix(from, to, double(i) / parts));
    if (at.depth > 0 && !in) in = before.normal;
    if (at.depth <= 0 && before.depth > 0 && in && glm::dot(*in, at.normal) < opposite) return true;
    before = at;
  }
  return false;
}

bool SolidPassages::observe(const softbody::World& world) {
  bool finite = true;
  for (collide::Index b = 0; b < world.bodies().count(); ++b) {
    const softbody::BodyModel& model = world.model(b);
    const glm::dvec3 to = middle_of(world.simulated().positions, b);
    if (b == outside_.size()) outside_.push_back(to);
    const bool known = std::isfinite(glm::distance(outside_[b], to));
    finite = finite && known;
    if (!model.mesh.closed || !known || softbody::solid_depth(world.scene(), to).depth > 0) continue;
    count_ += passed(world, outside_[b], to, model.radius);
    outside_[b] = to;
  }
  return finite;
}

}  // namespace app::report
