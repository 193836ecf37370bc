#pragma once
// Surface meshes. They give a soft body its particles and springs.

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
  std::vector<Edge> edges;        // polygon edges, ascending, unique, without the diagonals of quads
  std::vector<Edge> shear_pairs;  // both diagonals of each quad; empty for triangle meshes
  std::vector<Edge> bend_pairs;   // the vertices that a bend spring joins; ascending, unique
  std::vector<double> edge_shares, shear_shares,
      bend_shares;          // of a material's stiffness, of springs there; empty: all 1
  double stated_for = 162;  // number of vertices of the mesh of this kind that materials are stated for
  bool closed = false;      // every edge has two faces, so the mesh encloses a volume
};

/// Returns a sphere: an icosahedron whose faces are cut into four s = `subdivisions` times (0 to 6). It has
/// 10 * 4^s + 2 vertices and 20 * 4^s faces; s = 2 is the paper's body of 162 vertices and 320 faces. radius: > 0, in
/// m.
Mesh icosphere(int subdivisions, double radius);

/// Returns a flat sheet in the xz plane, centred at the origin: columns x rows quads (>= 1 each), width x depth metres.
/// Bend springs join each particle in both directions to the next but one, of finer grids than that which materials are
/// stated for (56 x 56 quads) to one that is as far away as the next but one is there.
Mesh quad_grid(int columns, int rows, double width, double depth);

/// Fills in all else from the vertices and triangles of a mesh. Whatever its resolution, the springs that it asks for
/// are as stiff as those of the sphere that materials are stated for, see connect_triangles.cpp.
void connect_triangles(Mesh& mesh);

/// Gives the vertices of triangles new numbers, from 0 in the order in which they come. Returns the old number of each.
std::vector<Index> renumber_vertices(std::vector<Triangle>& triangles);

/// Returns the signed volume of a closed triangle mesh in m^3, by the divergence theorem.
double volume(const std::vector<glm::dvec3>& vertices, const std::vector<Triangle>& triangles);

/// Returns the largest distance of a vertex from the mean of all vertices, in m.
double bounding_radius(const Mesh& mesh);

/// Returns how far (m) a point of a face is from the nearest corner of the face, at most.
double covering_radius(const Mesh& mesh);

}  // namespace softbody
