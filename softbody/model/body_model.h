#pragma once
// A body model holds everything that bodies of one mesh and one material share. Bodies of one model are solved
// together.

#include <memory>
#include <span>
#include <vector>

#include "softbody/mesh/mesh_import.h"
#include "softbody/model/material.h"

namespace collide {
class Shape;
}
namespace collide::surface {
class Surface;
}

namespace softbody {

struct ModelForces;

/// The energy in J that the forces inside a body store.
struct StoredEnergy {
  double elastic = 0;  // of all but:
  double gas = 0;      // forces that depend on the volume
  double total() const { return elastic + gas; }
};

/// A mesh with what detection and drawing need of it.
struct BodyMesh {
  Mesh mesh;
  std::shared_ptr<const collide::Shape> shape;               // for detectors
  std::shared_ptr<const collide::surface::Surface> surface;  // for surface contact and the oracle
  double mean_edge = 0;                                      // m, at rest
  double radius = 0;                                         // m, bounding radius of the mesh
  double covering = 0;                                       // m, covering radius of the mesh
};

/// A fine mesh that rides on the mesh of a body model.
struct FineMesh : BodyMesh {
  std::shared_ptr<const ImportedMesh> imported;  // with the coarse mesh and the embedding
  const Embedding& embedding() const { return imported->coarse->embedding; }
};

/// Its own mesh is the one that is simulated: each of its vertices is a particle.
struct BodyModel : BodyMesh {
  Material material;
  std::shared_ptr<const FineMesh> fine;       // null if the body shows its own mesh
  std::vector<Edge> opposite;                 // see edges_opposite(), of one vertex after another
  std::vector<Index> first_opposite{0};       // of each vertex, and one more
  bool rolls = false;                         // the mesh is closed, or has holes of less than a tenth of its area
  double particle_mass = 0;                   // kg
  std::vector<glm::dvec3> start;              // starting shape: the equilibrium, or the mesh itself
  double start_volume = 0;                    // m^3, 0 for open meshes
  StoredEnergy start_energy;                  // in the starting shape: the least if that is the equilibrium
  double largest_degree = 0;                  // largest number of faces at one particle
  std::shared_ptr<const ModelForces> forces;  // what the forces need, see forces/model_forces.h

  /// Returns the mesh that is drawn, and in which contacts are detected and compared.
  const BodyMesh& shown() const { return fine ? *fine : static_cast<const BodyMesh&>(*this); }
  /// Returns where the vertices of that mesh are at rest, m.
  const std::vector<glm::dvec3>& shown_at_rest() const { return fine ? fine->mesh.vertices : start; }
  /// Returns the triangles at a vertex.
  std::span<const Index> faces_of(Index vertex) const;
  /// Returns the edges opposite a vertex in its triangles, as these turn.
  std::span<const Edge> edges_opposite(Index vertex) const {
    return std::span(opposite).subspan(first_opposite[vertex], first_opposite[vertex + 1] - first_opposite[vertex]);
  }
};

/// Returns a body model that has its mesh, in the shape in which it starts, and no material yet.
std::shared_ptr<BodyModel> make_body_mesh(Mesh mesh);
/// Does the same for what a scene names, with the fine mesh if there is one.
std::shared_ptr<BodyModel> make_body_mesh(const MeshSource& source);

}  // namespace softbody
