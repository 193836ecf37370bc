#pragma once
// Reads two frames of a mesh in double precision, for contact in motion.

#include <filesystem>

#include "collide/oracle/moving_mesh.h"
#include "softbody/mesh/file_mesh.h"

namespace app::files {

struct MotionFiles {
  /// All vertices as in the files. Faces are triangles; polygons are cut as they lie in the first file. Edges are the
  /// sides of these triangles and the segments of lines. A body is what faces and lines connect; counted from 0.
  collide::oracle::MovingMesh mesh;
  std::size_t bodies = 0;
};

/// Reads the frames, which no output may replace from now on. Throws MeshFileError if one cannot be read, and
/// UsageError unless both have the same vertices, faces and lines.
MotionFiles read_motion(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace app::files
