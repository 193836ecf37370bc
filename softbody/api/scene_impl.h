#pragma once
// What a Scene has collected.

#include <optional>

#include "softbody/api/sbcollide/softbody.h"
#include "softbody/scene/scene.h"

namespace sbcollide {

struct Scene::Impl {
  std::filesystem::path file{"scene"};  // names the text in messages
  std::filesystem::path materials;
  std::string text;  // as of a scene file
  std::optional<glm::dvec3> gravity;
  std::vector<softbody::MeshSource> meshes;
  std::vector<Body> bodies;

  /// Returns the scene with all bodies. Throws SceneError or Error.
  softbody::Scene make() const;
};

/// Returns the body with its mesh of `meshes`. Throws Error if the mesh or the material does not exist.
softbody::BodySource body_source(const Body& body, const std::vector<softbody::MeshSource>& meshes,
                                 const std::vector<softbody::Material>& materials);

}  // namespace sbcollide
