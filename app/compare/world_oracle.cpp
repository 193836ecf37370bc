#include "app/compare/world_oracle.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "collide/surface/closed_shell.h"
#include "softbody/model/body_model.h"

namespace app::compare {

collide::surface::Surfaces surfaces_of(const softbody::BodiesInMotion& world) {
  collide::surface::Surfaces surfaces;
  for (collide::Index b = 0; b < world.bodies().count(); ++b) surfaces.push_back(world.model(b).surface);
  return surfaces;
}

collide::oracle::Overlaps WorldOracle::overlaps(const softbody::BodiesInMotion& world) {
  return collide::oracle::find_overlaps(world.simulated().positions, surfaces_of(world), workers_);
}

double WorldOracle::max_displacement(const softbody::BodiesInMotion& world) const {
  const collide::Frame now = world.simulated().positions;
  const Positions& before = before_.at;
  assert(now.x.size() >= before.x.size());
  double max2 = 0;
  for (std::size_t v = 0; v < before.x.size(); ++v) {
    const glm::dvec3 way(now.x[v] - before.x[v], now.y[v] - before.y[v], now.z[v] - before.z[v]);
    max2 = std::max(max2, glm::dot(way, way));
  }
  return std::sqrt(max2);
}

std::vector<collide::oracle::Crossing> WorldOracle::crossings(const softbody::BodiesInMotion& world) {
  const collide::Frame now = world.simulated().positions, before = before_.view();
  const std::size_t known = before.x.size();  // new bodies come after them
  const collide::Frame after{now.x.first(known), now.y.first(known), now.z.first(known), before.bodies};
  std::vector<collide::oracle::Crossing> found;
  if (max_displacement(world) > 0) found = collide::oracle::find_crossings(before, after, surfaces_, workers_);
  std::swap(earlier_, before_.at);
  before_.copy(now);
  surfaces_ = surfaces_of(world);
  return found;
}

bool WorldOracle::entered_body(const collide::oracle::Crossing& crossing) const {
  const collide::Index vertex = crossing.feature[0], first = before_.bodies.first[crossing.other];
  const auto inside = [&](const Positions& p) {
    const collide::VertexRun at{&p.x[first], &p.y[first], &p.z[first], before_.bodies.size(crossing.other)};
    return collide::surface::ClosedShell(*surfaces_[crossing.other], at)
        .inside({p.x[vertex], p.y[vertex], p.z[vertex]});
  };
  return inside(before_.at) && !inside(earlier_);
}

}  // namespace app::compare
