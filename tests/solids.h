#pragma once
// Solids of a scene by their shape.

#include <algorithm>
#include <utility>

#include "softbody/scene/scene.h"

namespace tests {

template <class Shape>
bool has_shape(const softbody::Solid& solid) {
  return std::holds_alternative<Shape>(solid.shape);
}

/// The first solid of a shape. The scene must have one.
template <class Shape>
auto& solid_of(auto& scene) {
  const auto first = std::ranges::find_if(scene.solids, has_shape<Shape>);
  return first == scene.solids.end() ? throw std::out_of_range("no solid of this shape") : *first;
}
template <class Shape>
auto& shape_of(auto& scene) {
  return std::get<Shape>(solid_of<Shape>(scene).shape);
}
template <class Shape>
void remove_solids(softbody::Scene& scene) {
  std::erase_if(scene.solids, has_shape<Shape>);
}
/// Adds a solid in the order of a scene file.
inline void add_solid(softbody::Scene& scene, softbody::Solid solid) {
  scene.solids.push_back(std::move(solid));
  std::ranges::stable_sort(scene.solids, {}, [](const softbody::Solid& s) { return s.shape.index(); });
}
/// The same, in place of those of its shape.
inline void set_solid(softbody::Scene& scene, softbody::Solid solid) {
  std::erase_if(scene.solids, [&](const softbody::Solid& s) { return s.shape.index() == solid.shape.index(); });
  add_solid(scene, std::move(solid));
}

}  // namespace tests
