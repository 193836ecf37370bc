#pragma once
// Changes of a world's scene.

#include "softbody/world/world.h"

namespace softbody {

/// Applies the world's scene as `edit` changes it.
void change(World& world, const auto& edit) {
  Scene scene = world.scene();
  edit(scene);
  world.apply(scene);
}

}  // namespace softbody
