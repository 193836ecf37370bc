#include "app/files/obj.h"

#include <algorithm>
#include <string>

namespace app {
namespace {

using collide::Index;

/// Adds the edges of a polygon; false if it reaches across bodies.
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

}  // namespace

ObjBodies read_obj(const std::filesystem::path& file) {
  softbody::ObjFile obj = softbody::read_obj_file(file);
  ObjBodies bodies{std::move(obj.x), std::move(obj.y), std::move(obj.z), std::move(obj.objects), {}};
  bodies.first.push_back(static_cast<Index>(bodies.x.size()));
  bodies.edges.resize(bodies.count());
  obj.for_each_face([&](std::span<const Index> corners, std::uint64_t line) {
    if (!add_edges(bodies, corners))
      throw ObjError(file.string() + ":" + std::to_string(line) +
                     ": a face across bodies; use the vertices of one object only in a face");
  });
  return bodies;
}

}  // namespace app
