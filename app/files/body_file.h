#pragma once
// Reads bodies from mesh files. Nothing is welded or cut into triangles, and no vertex is dropped.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "collide/core/frame.h"
#include "softbody/mesh/file_mesh.h"
#include "softbody/mesh/points.h"
#include "softbody/mesh/polygon.h"

namespace app::files {

using softbody::MeshFileError;

/// What a body of a file is.
enum class BodiesBy {
  objects,  // the vertices of an object. Each `o` of an OBJ file begins one, which may stay empty; vertices before the
            // first `o` are one, too; a PLY file is one. If all vertices stand before the first `o`, each body begins
            // with the first vertex that a face of its object names, unless this would mix the vertices of two
            // objects; vertices before all of these are a body of their own.
  components,  // vertices that faces connect, in the order of their first vertices; vertices without a face are
               // together the last one
  one          // everything
};

struct BodiesByKey {
  std::string_view key;  // on the command line
  BodiesBy value;
};
inline constexpr std::array<BodiesByKey, 3> bodies_by_keys{
    {{"objects", BodiesBy::objects}, {"components", BodiesBy::components}, {"one", BodiesBy::one}}};

/// The bodies of a file: which vertices and polygons belong to which. Vertices are numbered body by body; within a body
/// they keep the file's order.
struct BodyMeshes {
  using Edge = std::array<collide::Index, 2>;
  std::vector<collide::Index> first{0};       // body b owns the vertices first[b] .. first[b + 1] - 1
  std::vector<collide::Index> file_vertex;    // by vertex: its number in the file, from 0
  softbody::Polygons polygons;                // body by body, in the file's order; corners count from first[b]
  std::vector<std::size_t> first_polygon{0};  // body b has the polygons first_polygon[b] .. first_polygon[b + 1] - 1

  std::size_t count() const { return first.size() - 1; }
  collide::Index vertex_count() const { return first.back(); }
  collide::Index size(std::size_t body) const { return first[body + 1] - first[body]; }
  /// Returns the sides of a body's polygons, no diagonals; local indices, with duplicates.
  std::vector<Edge> edges(std::size_t body) const;
  /// Returns a body's polygons, each cut from its first corner; local indices.
  std::vector<softbody::Triangle> fans(std::size_t body) const;
};

/// Cuts a polygon into triangles. corners: numbers of vertices; position(corner): m. Calls take(triangle) for each.
template <class Position, class Take>
void for_each_triangle(std::span<const collide::Index> corners, const Position& position, const Take& take) {
  if (corners.size() == 3 || corners.size() > softbody::max_polygon_corners) {
    for (std::size_t i = 2; i < corners.size(); ++i) take(softbody::Triangle{corners[0], corners[i - 1], corners[i]});
    return;
  }
  std::vector<glm::dvec3> points;
  for (const collide::Index corner : corners) points.push_back(position(corner));
  for (const auto& [a, b, c] : softbody::triangulate(points))
    take(softbody::Triangle{corners[a], corners[b], corners[c]});
}

/// Returns the polygons of a body, cut into triangles by the positions of all vertices: a list of local indices,
/// without triangles that have a vertex twice. Nothing is welded, turned or dropped.
std::vector<softbody::Triangle> triangles_of(const BodyMeshes& meshes, std::size_t body, const softbody::Points& at);

/// Returns objects for an OBJ file, components for a PLY file.
BodiesBy default_bodies_by(const softbody::FileMesh& mesh);

/// Divides a mesh that was read from `file`. Throws MeshFileError if a face names vertices of several objects that are
/// bodies. notes: gets a line for each thing that the author may have meant differently.
BodyMeshes divide(const softbody::FileMesh& mesh, BodiesBy by, const std::filesystem::path& file,
                  std::vector<std::string>& notes);

/// Returns the positions of a mesh relative to `origin`, in the order of the bodies' vertices.
softbody::Points positions_of(const softbody::FileMesh& mesh, const BodyMeshes& bodies, const glm::dvec3& origin = {});

}  // namespace app::files
