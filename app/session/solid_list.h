#pragma once
// A scene's solids one by one, also those that are switched off.

#include <string>
#include <variant>

#include "softbody/scene.h"

namespace app {

using AnySolid = std::variant<softbody::Ground, softbody::SolidSphere, softbody::SolidPlane, softbody::SolidBox,
                              softbody::SolidCapsule>;

struct SolidEntry {
  AnySolid solid;
  bool on = true;
  bool operator==(const SolidEntry&) const = default;
};
using SolidList = std::vector<SolidEntry>;

SolidList list_solids(const softbody::Scene& scene);
/// Those that are on become the scene's solids.
void put_solids(const SolidList& list, softbody::Scene& scene);
/// "Ground", "Sphere 2"; each differs.
std::string solid_name(const SolidList& list, std::size_t index);

}  // namespace app
