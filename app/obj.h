#pragma once
// Bodies from Wavefront OBJ files, for `detect`: every number rounded correctly, every vertex where the file has it.

#include <array>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "collide/frame.h"

namespace app {

/// Bad input. what() is one line: the file, the line where there is one, what is wrong, what to do.
struct ObjError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What a file holds. Vertices as they are written, no welding; indices count from 0 over the file.
struct ObjBodies {
  using Edge = std::array<collide::Index, 2>;
  std::vector<float> x, y, z;            // finite
  std::vector<collide::Index> first;     // body b owns the vertices first[b] .. first[b + 1] - 1
  std::vector<std::vector<Edge>> edges;  // of each body's polygons, without diagonals; local, with duplicates

  std::size_t count() const { return first.size() - 1; }
  collide::Index size(std::size_t body) const { return first[body + 1] - first[body]; }
};

/// Every `o` begins a body, which may stay empty; vertices before the first `o` are a body too. Reads `v`, `o` and `f`
/// and passes over all other statements. A face may name vertices further down, but of one body only. Takes time in
/// proportion to the file's size and no more memory than the result and the faces need. Throws ObjError.
ObjBodies read_obj(const std::filesystem::path& file);

}  // namespace app
