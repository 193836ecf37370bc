#pragma once
// Surface meshes: where a soft body's particles and springs come from.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace softbody {

using Index = std::uint32_t;
using Edge = std::array<Index, 2>;      // i < j
using Triangle = std::array<Index, 3>;  // counter-clockwise seen from outside

inline Edge ordered(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

struct Mesh {
  std::vector<glm::dvec3> vertices;  // m, around the mesh's own origin
  std::vector<Triangle> triangles;
  std::vector<Edge> edges;        // polygon edges, ascending, unique; a quad's diagonals are not among them
  std::vector<Edge> shear_pairs;  // both diagonals of each quad; empty for triangle meshes
  std::vector<Edge> bend_pairs;   // the vertices that a bend spring joins across one edge or particle
  bool closed = false;            // every edge has two faces, so that it holds a volume
};

/// Unit icosahedron cut `subdivisions` times (each face into four), scaled to the radius: 10 * 4^s + 2 vertices,
/// 20 * 4^s faces; s = 2 is the paper's body of 162 and 320. subdivisions 0 .. 6, radius > 0 in metres.
Mesh icosphere(int subdivisions, double radius);

/// Flat sheet in the xz plane, centred: columns x rows quads (>= 1 each) over width x depth metres. Bend springs skip
/// one particle along both directions.
Mesh quad_grid(int columns, int rows, double width, double depth);

/// Fills in edges, bend pairs and closedness from the triangles.
void connect_triangles(Mesh& mesh);

/// Signed volume of a closed triangle mesh by the divergence theorem, in m^3.
double volume(const std::vector<glm::dvec3>& vertices, const std::vector<Triangle>& triangles);

/// Largest distance of a vertex from the vertices' mean, in m.
double bounding_radius(const Mesh& mesh);

}  // namespace softbody
