#pragma once
// A list of a scene's solids, including those that are switched off.

#include <optional>
#include <string>
#include <variant>

#include "softbody/scene/scene.h"

namespace app::session {

using AnySolid = std::variant<softbody::Ground, softbody::SolidSphere, softbody::SolidPlane, softbody::SolidBox,
                              softbody::SolidCapsule>;

struct SolidEntry {
  AnySolid solid;
  bool on = true;
  bool operator==(const SolidEntry&) const = default;
};
using SolidList = std::vector<SolidEntry>;

/// Returns the solids of a scene, all switched on.
SolidList list_solids(const softbody::Scene& scene);
/// Replaces the scene's solids by the entries that are switched on.
void put_solids(const SolidList& list, softbody::Scene& scene);
/// How far from the origin a solid may be moved along each axis (m).
inline constexpr double max_solid_coordinate = 20;
/// Returns a sphere, box or capsule moved by `by` (m); nothing for planes and grounds, which have no end to hold.
std::optional<AnySolid> moved(const AnySolid& solid, const glm::dvec3& by);
/// Returns the unique name of an entry, e.g. "Ground" or "Sphere 2". Precondition: index < list.size().
std::string solid_name(const SolidList& list, std::size_t index);

}  // namespace app::session
