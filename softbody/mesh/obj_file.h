#pragma once
// Reads Wavefront OBJ files exactly: every number is rounded correctly, and vertices and faces keep the file's order.

#include <filesystem>
#include <span>
#include <stdexcept>
#include <vector>

#include "softbody/mesh/mesh.h"

namespace softbody {

/// Bad input. what() is one line: the file, the line where there is one, what is wrong, what to do.
struct ObjError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Contents of an OBJ file. Indices count from 0 over the whole file.
struct ObjFile {
  struct Face {
    std::size_t end;     // of its corners in `corners`
    std::uint64_t line;  // of the file, from 1
  };
  struct Object {
    Index first_vertex;
    std::size_t first_face;
    bool named;  // it has a line `o`; false for what stands before the first one
  };
  std::vector<float> x, y, z;   // finite
  std::vector<Object> objects;  // in the order of their lines `o`; vertices before the first `o` are an object too
  std::vector<Index> corners;   // of all faces, one after another
  std::vector<Face> faces;      // of 3 or more corners
  std::size_t weights = 0;      // lines v X Y Z W with W other than 1, which only curves and surfaces use

  /// Calls visit(corners, line) for each face in the order of the file.
  void for_each_face(const auto& visit) const {
    std::size_t begin = 0;
    for (const Face& face : faces) {
      visit(std::span(corners).subspan(begin, face.end - begin), face.line);
      begin = face.end;
    }
  }
};

/// Reads the statements `v`, `o` and `f`. All other statements are ignored, and so is what follows the coordinates of a
/// vertex. A face may use vertices that come later in the file. The result has at least one object. The time is
/// proportional to the file's size, and no more memory is used than the result needs. Throws ObjError.
ObjFile read_obj_file(const std::filesystem::path& file);

}  // namespace softbody
