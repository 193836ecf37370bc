#include "app/files/body_file.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include "app/files/forest.h"

namespace app::files {
namespace {

using collide::Index;
using softbody::FileMesh;

/// The body of each vertex of a file.
struct Partition {
  std::vector<Index> body_of;
  std::size_t count = 0;  // of the bodies
};

// ---- objects ----

/// The smallest and the largest vertex that the faces of an object name.
struct Range {
  Index min = ~Index{0}, max = 0;
  bool empty() const { return min > max; }
};

std::vector<Range> ranges_of_faces(const FileMesh& mesh) {
  std::vector<Range> ranges(mesh.objects.size());
  std::size_t object = 0;
  mesh.for_each_face([&](std::span<const Index> corners, std::size_t face) {
    while (object + 1 < ranges.size() && mesh.objects[object + 1].first_face <= face) ++object;
    const auto [min, max] = std::ranges::minmax(corners);
    ranges[object].min = std::min(ranges[object].min, min);
    ranges[object].max = std::max(ranges[object].max, max);
  });
  return ranges;
}

/// Returns the first vertex of each object of a file whose vertices all stand before the first `o`: each object gets
/// the vertices that its faces name. Returns nothing if the vertices of two objects are mixed.
std::optional<std::vector<Index>> divide_by_faces(std::vector<Index> first, const std::vector<Range>& faces) {
  for (std::size_t object = faces.size(); object-- > 0;) {
    const Range& range = faces[object];
    if (!range.empty() && range.max >= first[object + 1]) return std::nullopt;
    if (object > 0) first[object] = range.empty() ? first[object + 1] : range.min;
  }
  if (first[1] == 0) first.erase(first.begin());
  return first;
}

Partition objects_of(const FileMesh& mesh, std::vector<std::string>& notes) {
  std::vector<Index> first;  // one more at the end
  for (const FileMesh::Object& object : mesh.objects) first.push_back(object.first_vertex);
  first.push_back(static_cast<Index>(mesh.x.size()));
  const std::vector<Range> faces = ranges_of_faces(mesh);
  std::size_t without_vertices = 0;
  for (std::size_t object = 0; object < faces.size(); ++object)
    if (first[object] == first[object + 1] && !faces[object].empty()) ++without_vertices;
  if (without_vertices > 0) {
    const bool vertices_first = !mesh.objects[0].named && first[1] == first.back();
    if (auto divided = vertices_first ? divide_by_faces(first, faces) : std::nullopt)
      first = *std::move(divided);
    else
      notes.push_back(std::to_string(without_vertices) +
                      " objects have faces of vertices that stand before them and count to another body; write "
                      "the vertices of an object after its line o");
  }
  Partition partition{{}, first.size() - 1};
  for (Index body = 0; body < partition.count; ++body) partition.body_of.resize(first[body + 1], body);
  return partition;
}

// ---- components ----

Partition components_of(const FileMesh& mesh) {
  constexpr Index none = ~Index{0};
  Forest forest(mesh.x.size());
  std::vector<char> has_face(mesh.x.size(), false);
  mesh.for_each_face([&](std::span<const Index> corners, std::size_t) {
    for (const Index corner : corners) {
      has_face[corner] = true;
      forest.join(corners[0], corner);
    }
  });
  Partition partition{std::vector<Index>(mesh.x.size(), none), 0};
  for (Index v = 0; v < mesh.x.size(); ++v) {
    if (!has_face[v]) continue;
    const Index first = forest.root(v);
    partition.body_of[v] = first == v ? static_cast<Index>(partition.count++) : partition.body_of[first];
  }
  if (std::ranges::count(has_face, char(false)) > 0)
    std::ranges::replace(partition.body_of, none, static_cast<Index>(partition.count++));
  return partition;
}

Partition partition_of(const FileMesh& mesh, BodiesBy by, std::vector<std::string>& notes) {
  switch (by) {
    case BodiesBy::objects:
      return objects_of(mesh, notes);
    case BodiesBy::components:
      return components_of(mesh);
    case BodiesBy::one:
      break;
  }
  return {std::vector<Index>(mesh.x.size(), 0), 1};
}

/// Elements in groups: group g has members[first[g]] .. members[first[g + 1] - 1], ascending.
template <class Number>
struct Groups {
  std::vector<Number> first, members;

  /// Makes `count` groups. Element i is in group_of(i), for all i < `size`.
  Groups(std::size_t count, std::size_t size, const auto& group_of) : first(count + 1, 0), members(size) {
    for (std::size_t i = 0; i < size; ++i) ++first[group_of(i) + std::size_t{1}];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<Number> next(first.begin(), first.end() - 1);
    for (std::size_t i = 0; i < size; ++i) members[next[group_of(i)]++] = static_cast<Number>(i);
  }
};

}  // namespace

BodiesBy default_bodies_by(const FileMesh& mesh) {
  return mesh.format == FileMesh::Format::obj ? BodiesBy::objects : BodiesBy::components;
}

BodyMeshes divide(const FileMesh& mesh, BodiesBy by, const std::filesystem::path& file,
                  std::vector<std::string>& notes) {
  const Partition partition = partition_of(mesh, by, notes);
  const std::vector<Index>& body_of = partition.body_of;
  const std::size_t count = partition.count;
  if (mesh.weights > 0)
    notes.push_back(std::to_string(mesh.weights) +
                    " vertices have a weight other than 1, which is passed over: it is for curves only");
  Groups<Index> vertices(count, body_of.size(), [&](std::size_t v) { return body_of[v]; });
  std::vector<Index> local(body_of.size());
  for (Index i = 0; i < local.size(); ++i) {
    const Index v = vertices.members[i];
    local[v] = i - vertices.first[body_of[v]];
  }
  const auto body_of_face = [&](std::size_t face) { return body_of[mesh.corners_of(face)[0]]; };
  Groups<std::size_t> faces(count, mesh.faces.size(), body_of_face);
  if (by == BodiesBy::components && count > 2 && 2 * count > mesh.faces.size() && !mesh.faces.empty())
    notes.push_back(std::to_string(mesh.faces.size()) + " faces are " + std::to_string(count) +
                    " bodies, since most share no vertex with another one; if they are one mesh, give --bodies one");
  BodyMeshes bodies{.first = std::move(vertices.first),
                    .file_vertex = std::move(vertices.members),
                    .polygons = {},
                    .first_polygon = std::move(faces.first)};
  bodies.polygons.corners.reserve(mesh.corners.size());
  bodies.polygons.ends.reserve(mesh.faces.size());
  for (const std::size_t face : faces.members) {
    for (const Index corner : mesh.corners_of(face)) {
      if (body_of[corner] != body_of_face(face))
        throw MeshFileError(file.string() + ":" + mesh.place(face) +
                            ": a face across bodies; use the vertices of one object only in a face, or give --bodies "
                            "components");
      bodies.polygons.corners.push_back(local[corner]);
    }
    bodies.polygons.ends.push_back(bodies.polygons.corners.size());
  }
  return bodies;
}

softbody::Points positions_of(const FileMesh& mesh, const BodyMeshes& bodies, const glm::dvec3& origin) {
  assert(mesh.x.size() == bodies.vertex_count());
  softbody::Points at;
  for (std::vector<float>* axis : {&at.x, &at.y, &at.z}) axis->reserve(mesh.x.size());
  for (const Index v : bodies.file_vertex) at.add(std::array{mesh.position(v) - origin});
  return at;
}

std::vector<BodyMeshes::Edge> BodyMeshes::edges(std::size_t body) const {
  std::vector<Edge> list;
  for (std::size_t p = first_polygon[body]; p < first_polygon[body + 1]; ++p) {
    Index previous = polygons[p].back();
    for (const Index vertex : polygons[p]) list.push_back({std::exchange(previous, vertex), vertex});
  }
  return list;
}

std::vector<softbody::Triangle> BodyMeshes::fans(std::size_t body) const {
  std::vector<softbody::Triangle> list;
  for (std::size_t p = first_polygon[body]; p < first_polygon[body + 1]; ++p) {
    const std::span<const Index> corners = polygons[p];
    for (std::size_t i = 2; i < corners.size(); ++i) list.push_back({corners[0], corners[i - 1], corners[i]});
  }
  return list;
}

std::vector<softbody::Triangle> triangles_of(const BodyMeshes& meshes, std::size_t body, const softbody::Points& at) {
  std::vector<softbody::Triangle> list;
  const auto position = [&](Index corner) {
    const Index v = meshes.first[body] + corner;
    return glm::dvec3(at.x[v], at.y[v], at.z[v]);
  };
  for (std::size_t p = meshes.first_polygon[body]; p < meshes.first_polygon[body + 1]; ++p) {
    for_each_triangle(meshes.polygons[p], position, [&](const softbody::Triangle& t) {
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) list.push_back(t);
    });
  }
  return list;
}

}  // namespace app::files
