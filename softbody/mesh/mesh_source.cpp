#include "softbody/mesh/mesh_source.h"

namespace softbody {

MeshSource MeshSource::from_file(const MeshFile& file, const std::function<void(std::string_view)>& begin_stage) {
  return {
      .kind = "file", .file = file, .imported = std::make_shared<const ImportedMesh>(import_mesh(file, begin_stage))};
}

Mesh MeshSource::make() const {
  if (kind == "file") return imported->simulated();
  return kind == "grid" ? quad_grid(columns, rows, width, depth) : icosphere(subdivisions, radius);
}

std::uint64_t MeshSource::particle_count() const {
  return kind == "file" ? imported->simulated().vertices.size() : vertex_count();
}

std::uint64_t MeshSource::vertex_count() const {
  if (kind == "file") return imported->mesh.vertices.size();
  return kind == "grid" ? std::uint64_t(columns + 1) * std::uint64_t(rows + 1) : 10 * (1ull << (2 * subdivisions)) + 2;
}

}  // namespace softbody
