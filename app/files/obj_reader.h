#pragma once
// Reads bodies from Wavefront OBJ files for `detect`. Nothing is welded or cut into triangles; each object is a body.

#include <array>
#include <string>
#include <vector>

#include "collide/core/frame.h"
#include "softbody/mesh/obj_file.h"

namespace app::files {

using softbody::ObjError;

/// The bodies of a file, with the vertices as they are written. Indices of vertices count from 0 over the whole file.
struct ObjBodies {
  using Edge = std::array<collide::Index, 2>;
  std::vector<float> x, y, z;            // finite
  std::vector<collide::Index> first;     // body b owns the vertices first[b] .. first[b + 1] - 1
  std::vector<std::vector<Edge>> edges;  // by body: of its polygons, no diagonals; local indices, with duplicates
  std::vector<std::string> notes;        // one line each: what the author may have meant differently

  std::size_t count() const { return first.size() - 1; }
  collide::Index size(std::size_t body) const { return first[body + 1] - first[body]; }
};

/// Reads a file. Each `o` begins a body, which may stay empty; vertices before the first `o` are a body, too. If all
/// vertices stand before the first `o`, each body begins with the first vertex that a face of its object names, unless
/// this would mix the vertices of two objects; vertices before all of these are a body of their own. Throws ObjError if
/// a face names vertices of several bodies, and wherever softbody::read_obj_file() does.
ObjBodies read_obj(const std::filesystem::path& file);

}  // namespace app::files
