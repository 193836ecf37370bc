#pragma once
// Bodies from Wavefront OBJ files, for `detect`: no welding, no triangles, every object a body.

#include <array>
#include <string>
#include <vector>

#include "collide/core/frame.h"
#include "softbody/obj_file.h"

namespace app {

using softbody::ObjError;

/// What a file holds. Vertices as they are written, no welding; indices count from 0 over the file.
struct ObjBodies {
  using Edge = std::array<collide::Index, 2>;
  std::vector<float> x, y, z;            // finite
  std::vector<collide::Index> first;     // body b owns the vertices first[b] .. first[b + 1] - 1
  std::vector<std::vector<Edge>> edges;  // of each body's polygons, without diagonals; local, with duplicates
  std::vector<std::string> notes;        // one line each: what may not be meant as it was read

  std::size_t count() const { return first.size() - 1; }
  collide::Index size(std::size_t body) const { return first[body + 1] - first[body]; }
};

/// Every `o` begins a body, which may stay empty; vertices before the first `o` are a body too. Where all vertices
/// stand before the first `o`, each body begins with the first vertex that a face of its object names, if so the faces
/// of each object name vertices of its body only; vertices before all of these are a body of their own. A face may name
/// vertices of one body only. Throws ObjError, as softbody::read_obj_file() does.
ObjBodies read_obj(const std::filesystem::path& file);

}  // namespace app
