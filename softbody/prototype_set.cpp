#include "softbody/prototype_set.h"

namespace softbody {

PrototypeSet::PrototypeSet(const Scene& scene) {
  for (const BodySource& b : scene.bodies) add(b, scene.materials);
  if (scene.dropper) add(scene.dropper->body, scene.materials);
}

const std::shared_ptr<const Prototype>& PrototypeSet::add(const BodySource& source,
                                                          const std::vector<Material>& materials) {
  const std::size_t known = index(source);
  if (known < all_.size()) return all_[known];
  auto made = make_prototype(source.mesh, materials[std::size_t(source.material)]);
  keys_.push_back(source);
  return all_.emplace_back(std::move(made));
}

void PrototypeSet::set_material(int index, const Material& material) {
  for (std::size_t i = 0; i < keys_.size(); ++i)
    if (keys_[i].material == index) all_[i] = with_material(*all_[i], keys_[i].mesh, material);
}

std::size_t PrototypeSet::index(const BodySource& source) const {
  std::size_t i = 0;
  while (i < keys_.size() && !(keys_[i].mesh == source.mesh && keys_[i].material == source.material)) ++i;
  return i;
}

}  // namespace softbody
