// Arbitrary bytes as an OBJ or a PLY file, which begins with the line `ply`: for `detect`, with and without
// --continuous, and as the mesh of a soft body they are read or refused in one line.

#include <cmath>

#include "require.h"
#include "softbody/mesh/mesh_import.h"
#include "tests/read_bodies.h"
#include "text_file.h"

namespace {

using app::files::BodiesBy;
using fuzz::require;

void check(const app::files::BodyFile& file) {
  const app::files::BodyMeshes& bodies = file.meshes;
  require(bodies.vertex_count() == file.at.x.size(), "bodies do not own all vertices");
  require(bodies.first_polygon.size() == bodies.count() + 1, "not a list of polygons for each body");
  require(bodies.first_polygon.back() == bodies.polygons.size(), "bodies do not own all polygons");
  for (std::size_t b = 0; b < bodies.count(); ++b)
    for (const auto& [i, j] : bodies.edges(b)) require(i < bodies.size(b) && j < bodies.size(b), "an edge to nowhere");
}

void check(const softbody::FileMesh& mesh) {
  for (const auto* axis : {&mesh.x, &mesh.y, &mesh.z})
    for (const double x : *axis) require(std::isfinite(x), "a coordinate that is not finite");
  for (const auto& [a, b, line] : mesh.segments) require(a < mesh.x.size() && b < mesh.x.size(), "a line to nowhere");
}

void check(const softbody::Mesh& mesh) {
  require(mesh.vertices.size() <= softbody::max_imported_vertices, "more vertices than allowed");
  for (const auto& triangle : mesh.triangles)
    for (const softbody::Index corner : triangle) require(corner < mesh.vertices.size(), "a corner that is none");
}

template <class Read>
void try_to(const std::filesystem::path& file, const Read& read) {
  try {
    check(read());
  } catch (const softbody::MeshFileError& error) {
    fuzz::require_one_line(error.what(), file);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fuzz::TextFile text(".obj");
  const std::filesystem::path& file = text.write(data, size);
  for (const BodiesBy by : {BodiesBy::objects, BodiesBy::components, BodiesBy::one})
    try_to(file, [&] { return app::files::read_bodies(file, by); });
  try_to(file, [&] { return softbody::read_file_mesh(file, {.doubles = true, .lines = true}); });
  softbody::MeshFile mesh;
  mesh.path = file;
  try_to(file, [&] { return softbody::import_mesh(mesh).mesh; });
  return 0;
}
