#pragma once
// One prototype for each different pair of mesh and material among a scene's bodies, its dropper and what is added.

#include "softbody/prototype.h"

namespace softbody {

/// The prototype of a mesh and a material: the one that is in use somewhere, since a balance may take long to find, or
/// a new one. If one in use has a material of another name but the same values, it is a copy of that. Throws SceneError
/// as make_prototype() does. On any thread.
std::shared_ptr<const Prototype> shared_prototype(const MeshSource& mesh, const Material& material);

class PrototypeSet {
 public:
  /// Throws SceneError as make_prototype() does.
  explicit PrototypeSet(const Scene& scene);
  /// The prototype of a source, made if there is none yet. Throws SceneError as make_prototype() does.
  const std::shared_ptr<const Prototype>& add(const BodySource& source, const std::vector<Material>& materials);
  /// Gives all prototypes of material number `index` this one instead: see with_material().
  void set_material(int index, const Material& material);
  /// source: one of those added.
  const std::shared_ptr<const Prototype>& of(const BodySource& source) const { return all_[index(source)]; }
  const std::vector<std::shared_ptr<const Prototype>>& all() const { return all_; }

 private:
  std::size_t index(const BodySource& source) const;

  std::vector<BodySource> keys_;
  std::vector<std::shared_ptr<const Prototype>> all_;
};

}  // namespace softbody
