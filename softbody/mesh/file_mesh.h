#pragma once
// Reads mesh files exactly: every number is rounded correctly, and vertices and faces keep the file's order.

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "softbody/mesh/mesh.h"

namespace softbody {

/// Bad input. what() is one line: the file, the line where there is one, what is wrong, what to do.
struct MeshFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Contents of a mesh file. Indices count from 0 over the whole file.
struct FileMesh {
  enum class Format { obj, ply_text, ply_binary };
  struct Face {
    std::size_t end;     // of its corners in `corners`
    std::uint64_t line;  // of the file, from 1; a binary file has no lines
  };
  struct Segment {
    Index a, b;
    std::uint64_t line;  // of the file, from 1
  };
  struct Object {
    Index first_vertex;
    std::size_t first_face;
    bool named;  // it has a line `o`; false for what stands before the first one
  };
  Format format = Format::obj;
  std::vector<double> x, y, z;    // finite
  std::vector<Object> objects;    // in the order of their lines `o`; vertices before the first `o` are an object too
  std::vector<Index> corners;     // of all faces, one after another
  std::vector<Face> faces;        // of 3 or more corners
  std::vector<Segment> segments;  // of the lines `l`, in the order of the file
  std::size_t weights = 0;        // lines v X Y Z W with W other than 1, which only curves and surfaces use
  int digits = 0;                 // the most significant ones of a coordinate; 0: a binary file

  std::span<const Index> corners_of(std::size_t face) const {
    const std::size_t begin = face > 0 ? faces[face - 1].end : 0;
    return std::span(corners).subspan(begin, faces[face].end - begin);
  }
  /// Calls visit(corners, face) for each face in the order of the file.
  void for_each_face(const auto& visit) const {
    for (std::size_t face = 0; face < faces.size(); ++face) visit(corners_of(face), face);
  }
  glm::dvec3 position(std::size_t vertex) const { return {x[vertex], y[vertex], z[vertex]}; }
  bool has_lines() const { return format != Format::ply_binary; }
  /// Returns the number by which a message names a face: its line from 1; in a file without lines its own from 0.
  std::uint64_t number_of(std::size_t face) const { return has_lines() ? faces[face].line : face; }
  /// Returns the number by which the file names vertex 0.
  unsigned first_number() const { return format == Format::obj ? 1 : 0; }
  /// Returns the place of a face, for a message that begins with the name of the file.
  std::string place(std::size_t face) const {
    return has_lines() ? std::to_string(number_of(face)) : " face " + std::to_string(face) + " (counted from 0)";
  }
};

struct MeshReading {
  bool doubles = false;  // coordinates are rounded to double, not to float
  bool lines = false;    // of OBJ files, the lines `l` are read, too
};

/// Returns a point of which floats can tell the points of a box from lo to hi: none is farther from it along an axis
/// than 2.5 times the box's extent. Its coordinates are multiples of a power of two of 2 to 4 times the extent. So it
/// is the origin itself for a box near the origin, and what floats hold they hold relative to it, too. lo, hi: finite.
glm::dvec3 origin_near(const glm::dvec3& lo, const glm::dvec3& hi);

/// Reads a Wavefront OBJ or a PLY file. A file is PLY if its name ends in .ply or its first line is `ply`. The result
/// has at least one object; a PLY file is one object. A face may use vertices that come later in the file. The time is
/// proportional to the file's size, and no more memory is used than the result needs. Throws MeshFileError.
///
/// Of OBJ it reads the statements `v`, `o` and `f`, and `l` on request. All others are ignored, and so is what follows
/// the coordinates of a vertex. Of PLY it reads x, y and z of the element `vertex`, and the lists vertex_indices (or
/// vertex_index) of the elements `face` and `tristrips`. All other elements and properties are skipped.
FileMesh read_file_mesh(const std::filesystem::path& file, const MeshReading& reading = {});

}  // namespace softbody
