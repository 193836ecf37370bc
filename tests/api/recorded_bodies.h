#pragma once
// Bodies of a scene in motion, for finders of the public interface.

#include <string>
#include <vector>

#include <sbcollide/collide.h>

#include "softbody/model/body_model.h"
#include "softbody/world/world.h"

namespace api::test {

/// A frame of a scene, and the bodies at rest.
struct RecordedBodies {
  RecordedBodies(const std::string& scene, int frame) : world(softbody::find_scene(scene, SBCOLLIDE_SCENES), {}) {
    while (world.frame() < frame) world.step();
    const collide::Frame now = world.positions();
    x = now.x, y = now.y, z = now.z;
  }

  /// Adds the bodies to a finder, or to whatever has the same function.
  void add_to(auto& finder) const {
    for (softbody::BodyId body = 0; body < world.bodies().count(); ++body) {
      const softbody::Mesh& mesh = world.model(body).shown().mesh;
      std::vector<float> rest;
      for (const glm::dvec3& v : mesh.vertices)
        for (int axis = 0; axis < 3; ++axis) rest.push_back(static_cast<float>(v[axis]));
      sbcollide::BodyMesh own{.vertices = world.bodies().size(body), .rest = rest};
      if (mesh.shear_pairs.empty())
        own.triangles = mesh.triangles;
      else
        own.edges = mesh.edges;  // of quads, whose diagonals join nothing
      finder.add_body(own);
    }
  }
  /// Returns the contacts that a detector finds itself.
  std::vector<sbcollide::Contact> contacts(const std::string& method, float tolerance) const {
    collide::Settings settings{.tolerance = tolerance};
    settings.cell_size = collide::automatic_cell_size(world.positions(), settings.levels, tolerance);
    collide::Workers alone(1);
    collide::Result found;
    collide::find_method(method)->make()->detect(world.positions(), settings, alone, found);
    return found.contacts;
  }

  softbody::World world;
  std::span<const float> x, y, z;
};

}  // namespace api::test
