#include "softbody/prototype_set.h"

namespace softbody {

PrototypeSet::PrototypeSet(const Scene& scene) {
  const auto add = [&](const BodySource& source) {
    if (index(source) < all_.size()) return;
    keys_.push_back(source);
    all_.push_back(make_prototype(source.mesh, scene.materials[std::size_t(source.material)]));
  };
  for (const BodySource& b : scene.bodies) add(b);
  if (scene.dropper) add(scene.dropper->body);
}

std::size_t PrototypeSet::index(const BodySource& source) const {
  std::size_t i = 0;
  while (i < keys_.size() && !(keys_[i].mesh == source.mesh && keys_[i].material == source.material)) ++i;
  return i;
}

}  // namespace softbody
