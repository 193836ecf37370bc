#pragma once
// The solids of a scene in the window: their order, their names, and how they are moved.

#include <string>
#include <vector>

#include "softbody/contact/solid.h"

namespace app::session {

/// Returns the indices of the solids in the order of lists: what has an end first, the ground last.
std::vector<std::size_t> listed(const std::vector<softbody::Solid>& solids);
/// How far from the origin a solid may be moved along each axis (m).
inline constexpr float max_solid_coordinate = 20;
/// Returns a solid moved by `by` (m), its first place within the limits.
softbody::Solid moved(softbody::Solid solid, const glm::dvec3& by);
/// Returns the unique name of a solid, e.g. "Ground" or "Sphere 2". Precondition: index < solids.size().
std::string solid_name(const std::vector<softbody::Solid>& solids, std::size_t index);

}  // namespace app::session
