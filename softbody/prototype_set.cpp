#include "softbody/prototype_set.h"

#include <algorithm>
#include <mutex>

namespace softbody {
namespace {

struct InUse {
  MeshSource mesh;
  Material material;  // without its name
  std::weak_ptr<const Prototype> prototype;
};

std::mutex in_use_mutex;
std::vector<InUse> in_use;  // and some that were

std::shared_ptr<const Prototype> find_in_use(const MeshSource& mesh, const Material& nameless) {
  const std::scoped_lock lock(in_use_mutex);
  std::erase_if(in_use, [](const InUse& one) { return one.prototype.expired(); });
  const auto one = std::ranges::find_if(
      in_use, [&](const InUse& known) { return known.mesh == mesh && known.material == nameless; });
  return one == in_use.end() ? nullptr : one->prototype.lock();
}

}  // namespace

std::shared_ptr<const Prototype> shared_prototype(const MeshSource& mesh, const Material& material) {
  Material nameless = material;
  nameless.name.clear();
  if (auto known = find_in_use(mesh, nameless)) return known;
  auto made = make_prototype(mesh, material);
  const std::scoped_lock lock(in_use_mutex);
  in_use.push_back({mesh, std::move(nameless), made});
  return made;
}

PrototypeSet::PrototypeSet(const Scene& scene) {
  for (const BodySource& b : scene.bodies) add(b, scene.materials);
  if (scene.dropper) add(scene.dropper->body, scene.materials);
}

const std::shared_ptr<const Prototype>& PrototypeSet::add(const BodySource& source,
                                                          const std::vector<Material>& materials) {
  const std::size_t known = index(source);
  if (known < all_.size()) return all_[known];
  auto made = shared_prototype(source.mesh, materials[std::size_t(source.material)]);
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
