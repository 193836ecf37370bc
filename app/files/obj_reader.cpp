#include "app/files/obj_reader.h"

#include <algorithm>
#include <optional>
#include <string>

#include "app/files/inputs.h"

namespace app::files {
namespace {

using collide::Index;

/// Adds the edges of a polygon. Returns false if its corners belong to several bodies.
bool add_edges(ObjBodies& bodies, std::span<const Index> corners) {
  const auto next_body = std::upper_bound(bodies.first.begin(), bodies.first.end(), corners[0]);
  const Index begin = *(next_body - 1), end = *next_body;
  auto& edges = bodies.edges[static_cast<std::size_t>(next_body - bodies.first.begin()) - 1];
  Index previous = corners.back();
  for (const Index vertex : corners) {
    if (vertex < begin || vertex >= end) return false;
    edges.push_back({previous - begin, vertex - begin});
    previous = vertex;
  }
  return true;
}

/// The smallest and the largest vertex that the faces of an object name.
struct Range {
  Index min = ~Index{0}, max = 0;
  bool empty() const { return min > max; }
};

std::vector<Range> ranges_of_faces(const softbody::ObjFile& obj) {
  std::vector<Range> ranges(obj.objects.size());
  std::size_t object = 0, face = 0;
  obj.for_each_face([&](std::span<const Index> corners, std::uint64_t) {
    while (object + 1 < ranges.size() && obj.objects[object + 1].first_face <= face) ++object;
    const auto [min, max] = std::ranges::minmax(corners);
    ranges[object].min = std::min(ranges[object].min, min);
    ranges[object].max = std::max(ranges[object].max, max);
    ++face;
  });
  return ranges;
}

/// Returns ObjBodies::first for a file whose vertices all stand before the first `o`: each object gets the vertices
/// that its faces name. Returns nothing if the vertices of two objects are mixed.
std::optional<std::vector<Index>> divide_by_faces(std::vector<Index> first, const std::vector<Range>& faces) {
  for (std::size_t object = faces.size(); object-- > 0;) {
    const Range& range = faces[object];
    if (!range.empty() && range.max >= first[object + 1]) return std::nullopt;
    if (object > 0) first[object] = range.empty() ? first[object + 1] : range.min;
  }
  if (first[1] == 0) first.erase(first.begin());
  return first;
}

/// Fills in bodies.first.
void divide(ObjBodies& bodies, const softbody::ObjFile& obj) {
  for (const softbody::ObjFile::Object& object : obj.objects) bodies.first.push_back(object.first_vertex);
  bodies.first.push_back(static_cast<Index>(bodies.x.size()));
  const std::vector<Range> faces = ranges_of_faces(obj);
  std::size_t without_vertices = 0;
  for (std::size_t object = 0; object < faces.size(); ++object)
    if (bodies.size(object) == 0 && !faces[object].empty()) ++without_vertices;
  if (without_vertices == 0) return;
  const bool vertices_first = !obj.objects[0].named && bodies.first[1] == bodies.first.back();
  if (auto first = vertices_first ? divide_by_faces(bodies.first, faces) : std::nullopt)
    bodies.first = *std::move(first);
  else
    bodies.notes.push_back(std::to_string(without_vertices) +
                           " objects have faces of vertices that stand before them and count to another body; write "
                           "the vertices of an object after its line o");
}

}  // namespace

ObjBodies read_obj(const std::filesystem::path& file) {
  protect_input(file);
  softbody::ObjFile obj = softbody::read_obj_file(file);
  ObjBodies bodies{std::move(obj.x), std::move(obj.y), std::move(obj.z), {}, {}, {}};
  divide(bodies, obj);
  if (obj.weights > 0)
    bodies.notes.push_back(std::to_string(obj.weights) +
                           " vertices have a weight other than 1, which is passed over: it is for curves only");
  bodies.edges.resize(bodies.count());
  obj.for_each_face([&](std::span<const Index> corners, std::uint64_t line) {
    if (!add_edges(bodies, corners))
      throw ObjError(file.string() + ":" + std::to_string(line) +
                     ": a face across bodies; use the vertices of one object only in a face");
  });
  return bodies;
}

}  // namespace app::files
