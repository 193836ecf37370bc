#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "softbody/mesh/mesh_import.h"

namespace softbody {

/// Where a body's mesh comes from.
struct MeshSource {
  std::string kind = "icosphere";
  int subdivisions = 2;                            // icosphere
  double radius = 0.5;                             // m, icosphere
  int columns = 32, rows = 32;                     // grid
  double width = 3, depth = 3;                     // m, grid
  MeshFile file{};                                 // file
  std::shared_ptr<const ImportedMesh> imported{};  // file: the imported mesh, shared by all its bodies
  /// Imports the file as import_mesh() does.
  static MeshSource from_file(const MeshFile& file, const std::function<void(std::string_view)>& begin_stage = {});
  /// Returns the mesh that is simulated.
  Mesh make() const;
  // Found without making a mesh.
  std::uint64_t particle_count() const;  // vertices of the mesh that is simulated
  std::uint64_t vertex_count() const;    // of the one that is shown
  bool operator==(const MeshSource&) const = default;
};

}  // namespace softbody
