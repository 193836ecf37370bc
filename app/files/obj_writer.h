#pragma once
// Writes bodies as OBJ text. `detect` reads it back as the same bodies with the same edges and, to the bit, positions.

#include <filesystem>
#include <string>
#include <vector>

#include "softbody/mesh/points.h"
#include "softbody/world/bodies_in_motion.h"

namespace app::files {

inline constexpr const char* rest_shape_name = "rest.obj";  // of the file at_rest() beside those of the frames
// Of the file surroundings() beside them, which begins with the heading.
inline constexpr const char* surroundings_name = "scene.toml";
inline constexpr const char* surroundings_heading = "# Where the frames beside this file were recorded, for --play.\n";

/// Keeps the faces and the rest positions of a world's bodies, and combines them with the positions of frames.
class ObjWriter {
 public:
  explicit ObjWriter(const softbody::BodiesInMotion& world);

  /// Returns true if these are still the bodies of the world.
  bool matches(const softbody::BodiesInMotion& world) const;

  /// Returns false if a coordinate is not finite: no file can hold it.
  static bool can_write(const softbody::ConstPoints& at);
  /// Returns the file of one frame: each body is an object, body_0 and so on. at: of all vertices. Precondition:
  /// can_write(at).
  std::string frame(const softbody::ConstPoints& at) const;
  /// Returns the bodies at rest, inflated as they start, each about its own origin: --rest asks for distances and
  /// boxes.
  std::string at_rest() const { return frame(rest_); }
  /// Writes the scene of the world without its bodies into a folder: the solids, the camera, and how contacts are
  /// found. open_recording() reads it. Writes nothing if no scene file can hold it. Throws UsageError.
  void write_surroundings(const std::filesystem::path& folder) const;

 private:
  std::vector<const softbody::BodyModel*> models_;  // only for comparison: the world may be gone
  std::vector<std::size_t> first_;                  // by body: its first vertex; one more at the end
  std::vector<std::string> faces_;                  // by body
  softbody::Points rest_;
  std::string surroundings_;
};

}  // namespace app::files
