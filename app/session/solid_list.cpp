#include "app/session/solid_list.h"

#include <algorithm>
#include <array>
#include <cassert>

#include <glm/common.hpp>

namespace app::session {
namespace {

template <class Solid>
void add(const std::vector<Solid>& solids, SolidList& list) {
  for (const Solid& solid : solids) list.push_back({solid});
}

/// Returns the place moved by `by`, within the limits. One that is beyond them may come back.
glm::dvec3 place(const glm::dvec3& from, const glm::dvec3& by) {
  const glm::dvec3 limit(max_solid_coordinate);
  return glm::clamp(from + by, glm::min(-limit, from), glm::max(limit, from));
}

bool move(softbody::SolidSphere& s, const glm::dvec3& by) { return s.centre = place(s.centre, by), true; }
bool move(softbody::SolidBox& b, const glm::dvec3& by) { return b.centre = place(b.centre, by), true; }
bool move(softbody::SolidCapsule& c, const glm::dvec3& by) {
  const glm::dvec3 axis = c.to - c.from;
  c.from = place(c.from, by);
  c.to = c.from + axis;
  return true;
}
bool move(softbody::SolidPlane&, const glm::dvec3&) { return false; }
bool move(softbody::Ground&, const glm::dvec3&) { return false; }

void put(const softbody::Ground& ground, softbody::Scene& scene) { scene.ground = ground; }
void put(const softbody::SolidSphere& sphere, softbody::Scene& scene) { scene.spheres.push_back(sphere); }
void put(const softbody::SolidPlane& plane, softbody::Scene& scene) { scene.planes.push_back(plane); }
void put(const softbody::SolidBox& box, softbody::Scene& scene) { scene.boxes.push_back(box); }
void put(const softbody::SolidCapsule& capsule, softbody::Scene& scene) { scene.capsules.push_back(capsule); }

}  // namespace

SolidList list_solids(const softbody::Scene& scene) {
  SolidList list;
  add(scene.spheres, list);
  add(scene.boxes, list);
  add(scene.capsules, list);
  add(scene.planes, list);
  if (scene.ground) list.push_back({*scene.ground});
  return list;
}

void put_solids(const SolidList& list, softbody::Scene& scene) {
  scene.spheres.clear();
  scene.planes.clear();
  scene.boxes.clear();
  scene.capsules.clear();
  scene.ground.reset();
  for (const SolidEntry& entry : list)
    if (entry.on) std::visit([&](const auto& solid) { put(solid, scene); }, entry.solid);
}

std::optional<AnySolid> moved(const AnySolid& solid, const glm::dvec3& by) {
  AnySolid there = solid;
  if (std::visit([&](auto& one) { return move(one, by); }, there)) return there;
  return std::nullopt;
}

std::string solid_name(const SolidList& list, std::size_t index) {
  assert(index < list.size());
  static constexpr std::array names{"Ground", "Sphere", "Plane", "Box", "Capsule"};  // in the order of AnySolid
  const std::size_t kind = list[index].solid.index();
  const auto same = [kind](const SolidEntry& entry) { return entry.solid.index() == kind; };
  if (std::ranges::count_if(list, same) == 1) return names[kind];
  const auto end = list.begin() + static_cast<std::ptrdiff_t>(index);
  return names[kind] + (' ' + std::to_string(1 + std::count_if(list.begin(), end, same)));
}

}  // namespace app::session
