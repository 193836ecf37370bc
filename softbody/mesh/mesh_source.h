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
  /// Imports the file. Throws MeshFileError.
  static MeshSource from_file(const MeshFile& file);
  Mesh make() const;
  std::uint64_t vertex_count() const;  // of the mesh, found without making it
  bool operator==(const MeshSource&) const = default;
};

}  // namespace softbody
