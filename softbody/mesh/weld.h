#pragma once
// Vertices of an OBJ file that are the same one but for a seam.

#include <cstddef>
#include <span>
#include <vector>

#include "softbody/mesh/obj_file.h"
#include "softbody/mesh/polygon.h"

namespace softbody {

/// The faces of a file as polygons. Corners that repeat the one before are left out, and so are spikes, which run to a
/// vertex and straight back.
struct Outlines {
  Polygons polygons;                 // of the vertices that the file's were welded to
  std::vector<std::size_t> face;     // of each polygon, in the file
  std::size_t degenerate_faces = 0;  // left out, with fewer than three corners left
  std::size_t duplicate_faces = 0;   // left out, since an earlier one has the same outline, either way round
};
Outlines outlines(const ObjFile& file, std::span<const Index> welded_to);

/// Returns for each vertex the vertex that it becomes. Vertices that are no further apart than `distance` are at the
/// same place. Two of them are welded if a side of a face joins them, or if both end an open side, which only one face
/// has. Where this would give an edge more than two faces, as where closed parts touch, fewer are welded. The rules are
/// tried in this order:
///   1. only vertices of the same connected piece;
///   2. only those of the same object, if rule 1 leaves more than two open sides at one place;
///   3. only those of faces that follow one another in the file;
///   4. all of them: then the mesh has an edge with more than two faces, and is refused.
/// A piece whose faces all lie on faces of other pieces is welded to these. distance: in the units of `positions`, >=
/// 0.
std::vector<Index> weld(const ObjFile& file, std::span<const glm::dvec3> points, double distance);

}  // namespace softbody
