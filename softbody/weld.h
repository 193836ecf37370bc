#pragma once
// Vertices of an OBJ file that are the same one but for a seam.

#include <cstddef>
#include <span>
#include <vector>

#include "softbody/obj_file.h"
#include "softbody/polygon.h"

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

/// For each vertex the one that it becomes. Vertices no further apart than `distance` are at
/// the same place. They are welded if a side of a face joins them, or if they end open sides, which one face has. Where
/// this would give an edge more than two faces, as where closed parts touch, only vertices of the same piece
/// are welded; if that leaves more than two open sides at the same place, those of the same object, else those of faces
/// that follow one another in the file. If nothing helps, all are welded. A piece that lies on others with all its
/// faces is welded to them. distance: in the units of `positions`, at least 0.
std::vector<Index> weld(const ObjFile& file, std::span<const glm::dvec3> positions, double distance);

}  // namespace softbody
