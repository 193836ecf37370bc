#include "app/files/motion_file.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/base/usage_error.h"
#include "app/files/body_file.h"
#include "app/files/forest.h"
#include "app/files/inputs.h"

namespace app::files {
namespace {

using collide::Index;
using softbody::FileMesh;

/// A file and what was read from it.
struct Frame {
  std::string file;
  FileMesh mesh;
};

Frame read_frame(const std::filesystem::path& file) {
  protect_input(file);
  return {file.string(), softbody::read_file_mesh(file, {.doubles = true, .lines = true})};
}

/// Throws UsageError unless both frames have the same vertices, faces and lines.
void require_match(const Frame& from, const Frame& to) {
  const auto refuse = [](const std::string& difference) {
    throw UsageError(difference + "; give two frames of one mesh");
  };
  const auto require_number = [&](const char* of, std::size_t in_from, std::size_t in_to) {
    if (in_from != in_to) refuse(fmt::format("{}: number of {} {}, in {} {}", to.file, of, in_to, from.file, in_from));
  };
  const FileMesh &a = from.mesh, &b = to.mesh;
  require_number("vertices", a.x.size(), b.x.size());
  require_number("faces", a.faces.size(), b.faces.size());
  require_number("segments of lines", a.segments.size(), b.segments.size());
  for (std::size_t face = 0; face < a.faces.size(); ++face)
    if (!std::ranges::equal(a.corners_of(face), b.corners_of(face)))
      refuse(fmt::format("{}:{}: another face than {}:{}", to.file, b.place(face), from.file, a.place(face)));
  for (std::size_t k = 0; k < a.segments.size(); ++k) {
    const FileMesh::Segment &s = a.segments[k], &t = b.segments[k];
    if (s.a != t.a || s.b != t.b)
      refuse(fmt::format("{}:{}: another line than {}:{}", to.file, t.line, from.file, s.line));
  }
}

template <class T>
void sort_unique(std::vector<T>& values) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// Adds the features of the mesh, each once.
void add_features(const FileMesh& file, collide::oracle::MovingMesh& mesh) {
  for (Index v = 0; v < file.x.size(); ++v) mesh.vertices.push_back({v});
  const auto position = [&](Index v) { return mesh.points[v].from; };
  file.for_each_face([&](std::span<const Index> corners, std::size_t) {
    for_each_triangle(corners, position, [&](const softbody::Triangle& t) { mesh.faces.push_back(t); });
  });
  const auto add_edge = [&](Index a, Index b) {
    if (a != b) mesh.edges.push_back({std::min(a, b), std::max(a, b)});
  };
  for (const auto& [a, b, c] : mesh.faces) {
    add_edge(a, b);
    add_edge(b, c);
    add_edge(c, a);
  }
  for (const FileMesh::Segment& segment : file.segments) add_edge(segment.a, segment.b);
  sort_unique(mesh.faces);
  sort_unique(mesh.edges);
}

}  // namespace

MotionFiles read_motion(const std::filesystem::path& from, const std::filesystem::path& to) {
  const Frame first = read_frame(from), last = read_frame(to);
  require_match(first, last);
  MotionFiles motion;
  for (Index v = 0; v < first.mesh.x.size(); ++v)
    motion.mesh.points.push_back({first.mesh.position(v), last.mesh.position(v)});
  add_features(first.mesh, motion.mesh);
  Forest forest(motion.mesh.points.size());
  for (const auto& [a, b] : motion.mesh.edges) forest.join(a, b);
  for (Index v = 0; v < motion.mesh.points.size(); ++v) {
    const Index root = forest.root(v);
    motion.mesh.body.push_back(root == v ? static_cast<Index>(motion.bodies++) : motion.mesh.body[root]);
  }
  return motion;
}

}  // namespace app::files
