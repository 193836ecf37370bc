#pragma once
// Shares body models between bodies.

#include "softbody/model/body_model.h"
#include "softbody/scene/scene.h"

namespace softbody {

/// Returns the body model of a mesh and a material. A model that is in use somewhere is shared, since an equilibrium
/// may take long to find. A model whose material differs only in its name is copied. Throws SceneError as
/// make_body_model() does. May be called on any thread.
std::shared_ptr<const BodyModel> shared_body_model(const MeshSource& mesh, const Material& material);

/// Returns the body model of a body whose motion is recorded: no force acts on it. `mesh` has the shape of its first
/// frame; `shape` decides which pairs of its vertices can be contacts.
std::shared_ptr<const BodyModel> recorded_body_model(Mesh mesh, std::shared_ptr<const collide::Shape> shape);

/// Holds one body model for each pair of mesh and material among a scene's bodies, its dropper and added bodies.
class BodyModelSet {
 public:
  /// Throws SceneError as make_body_model() does.
  explicit BodyModelSet(const Scene& scene);
  /// Returns the body model of a source; makes it if it is new. Throws SceneError as make_body_model() does.
  const std::shared_ptr<const BodyModel>& add(const BodySource& source, const std::vector<Material>& materials);
  /// Replaces the material of all body models of material number `index`: see with_material().
  void set_material(int index, const Material& material);
  /// Returns the body model of a source that was added.
  const std::shared_ptr<const BodyModel>& of(const BodySource& source) const { return all_[index(source)]; }
  const std::vector<std::shared_ptr<const BodyModel>>& all() const { return all_; }

 private:
  std::size_t index(const BodySource& source) const;

  std::vector<BodySource> keys_;
  std::vector<std::shared_ptr<const BodyModel>> all_;
};

}  // namespace softbody
