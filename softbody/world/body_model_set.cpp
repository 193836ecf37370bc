#include "softbody/world/body_model_set.h"

#include <mutex>
#include <utility>

#include "softbody/forces/model_forces.h"
#include "softbody/mechanics/make_body_model.h"

namespace softbody {
namespace {

struct InUse {
  MeshSource mesh;  // keeps an imported mesh in memory
  Material material;
  std::weak_ptr<const BodyModel> model;
};

std::mutex in_use_mutex;
std::vector<InUse> in_use;  // find_in_use() removes those whose model is gone

std::shared_ptr<const BodyModel> find_in_use(const MeshSource& mesh, const Material& material, bool any_name) {
  const std::scoped_lock lock(in_use_mutex);
  std::erase_if(in_use, [](const InUse& one) { return one.model.expired(); });
  Material wanted = material;
  for (const InUse& known : in_use) {
    if (any_name) wanted.name = known.material.name;
    if (known.mesh == mesh && known.material == wanted) return known.model.lock();
  }
  return nullptr;
}

}  // namespace

std::shared_ptr<const BodyModel> shared_body_model(const MeshSource& mesh, const Material& material) {
  if (auto known = find_in_use(mesh, material, false)) return known;
  std::shared_ptr<const BodyModel> made;
  if (const auto known = find_in_use(mesh, material, true)) {
    auto copy = std::make_shared<BodyModel>(*known);
    copy->material.name = material.name;
    made = std::move(copy);
  } else {
    made = make_body_model(mesh, material);
  }
  const std::scoped_lock lock(in_use_mutex);
  in_use.push_back({mesh, material, made});
  return made;
}

std::shared_ptr<const BodyModel> recorded_body_model(Mesh mesh, std::shared_ptr<const collide::Shape> shape) {
  auto p = make_body_mesh(std::move(mesh));
  p->shape = std::move(shape);
  p->forces = std::make_shared<const ModelForces>();
  return p;
}

BodyModelSet::BodyModelSet(const Scene& scene) {
  for (const BodySource& b : scene.bodies) add(b, scene.materials);
  if (scene.dropper) add(scene.dropper->body, scene.materials);
}

const std::shared_ptr<const BodyModel>& BodyModelSet::add(const BodySource& source,
                                                          const std::vector<Material>& materials) {
  const std::size_t known = index(source);
  if (known < all_.size()) return all_[known];
  auto made = shared_body_model(source.mesh, materials[std::size_t(source.material)]);
  keys_.push_back(source);
  return all_.emplace_back(std::move(made));
}

void BodyModelSet::set_material(int index, const Material& material) {
  for (std::size_t i = 0; i < keys_.size(); ++i)
    if (keys_[i].material == index) all_[i] = with_material(*all_[i], keys_[i].mesh, material);
}

std::size_t BodyModelSet::index(const BodySource& source) const {
  std::size_t i = 0;
  while (i < keys_.size() && !(keys_[i].mesh == source.mesh && keys_[i].material == source.material)) ++i;
  return i;
}

}  // namespace softbody
