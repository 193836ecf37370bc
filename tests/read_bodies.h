#pragma once
// Reads the bodies of one mesh file, as a sequence reads those of its first file.

#include "app/files/body_file.h"

namespace app::files {

struct BodyFile {
  BodyMeshes meshes;
  softbody::Points at;             // of the vertices of `meshes`
  std::vector<std::string> notes;  // one line each: what the author may have meant differently
};

/// by: left out, the default of the format. Throws MeshFileError.
inline BodyFile read_bodies(const std::filesystem::path& file, std::optional<BodiesBy> by = {}) {
  const softbody::FileMesh mesh = softbody::read_file_mesh(file);
  BodyFile read;
  read.meshes = divide(mesh, by.value_or(default_bodies_by(mesh)), file, read.notes);
  read.at = positions_of(mesh, read.meshes);
  return read;
}

}  // namespace app::files
