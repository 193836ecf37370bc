#pragma once
// Makes a coarse mesh that can be simulated in place of a fine one.

#include <cstddef>
#include <optional>

#include "softbody/mesh/embedding.h"
#include "softbody/mesh/mesh.h"

namespace softbody {

/// A mesh of few vertices, taken from those of a fine mesh, which rides on it.
struct CoarseMesh {
  Mesh mesh;
  Embedding embedding;        // of the fine mesh's vertices
  double distance = 0;        // m, between the surfaces at rest, see coarsen()
  std::size_t crossings = 0;  // edges of the coarse mesh that stick through faces of it
};

/// Returns a mesh of about so many vertices by meshoptimizer's edge collapses; of more where so few cannot have the
/// form of the fine mesh. Each part is there, closed if the fine one is, and no edge has more than two faces. Of some
/// tries it is the one whose surface crosses itself least. `distance` is the largest of those of the fine vertices from
/// the coarse triangles that hold them, and of the middles of coarse edges and faces from the fine surface. Returns
/// nothing if no try has such a mesh. vertices: at least 4 and less than the fine mesh has.
std::optional<CoarseMesh> coarsen(const Mesh& fine, std::size_t vertices);

}  // namespace softbody
