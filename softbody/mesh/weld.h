#pragma once
// Welds the seams of a mesh file: vertices at the same place become one.

#include <cstddef>
#include <span>
#include <vector>

#include "softbody/mesh/file_mesh.h"
#include "softbody/mesh/polygon.h"

namespace softbody {

/// The faces of a file as polygons. A corner that repeats the one before is left out, and so are spikes: corners from
/// which the outline runs straight back.
struct Outlines {
  Polygons polygons;                 // of the welded vertices
  std::vector<std::size_t> face;     // the file's face of each polygon
  std::size_t degenerate_faces = 0;  // left out: fewer than three corners remained
  std::size_t duplicate_faces = 0;   // left out: an earlier face has the same outline, in either direction
};
Outlines outlines(const FileMesh& file, std::span<const Index> welded_to);

/// Returns for each vertex the vertex that it is welded to. Vertices no further apart than `distance` count as at the
/// same place. Two of them are welded if a side of a face connects them, or if both are ends of open sides, which have
/// one face only. If this would give an edge more than two faces, as where closed parts touch, fewer are welded. The
/// rules are tried in this order:
///   1. only vertices of the same connected piece;
///   2. only those of the same object, if rule 1 leaves more than two open sides at one place;
///   3. only those of faces that follow one another in the file;
///   4. all of them; the mesh then has an edge with more than two faces and is refused.
/// A piece whose faces all lie on faces of other pieces is welded to those pieces. distance: >= 0, in units of
/// `points`.
std::vector<Index> weld(const FileMesh& file, std::span<const glm::dvec3> points, double distance);

}  // namespace softbody
