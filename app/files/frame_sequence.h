#pragma once
// A recorded sequence: mesh files that are consecutive frames of the same bodies.

#include <filesystem>
#include <memory>

#include "app/files/body_file.h"

namespace app::files {

/// The bodies of a frame. Frames with the same bodies share it.
struct SequenceBodies {
  BodyMeshes meshes;  // of the file in which these bodies come first
  collide::Bodies bodies;
};

/// One frame of a sequence.
struct SequenceFrame {
  std::shared_ptr<const SequenceBodies> of;
  softbody::Points at;

  collide::Frame view() const { return {at.x, at.y, at.z, &of->bodies}; }
};

/// Reads the frames of a sequence on demand and keeps none of them, except the first one until it is asked for: it may
/// come through a pipe. The first file decides which vertices belong to which body and which edges and faces there are.
/// Another file must match it body by body; where its bodies are components, it may have the same vertices without
/// faces.
class FrameSequence {
 public:
  struct Options {
    std::optional<BodiesBy> by{};                 // left out: the default of the first file's format
    std::optional<std::filesystem::path> rest{};  // the bodies of the first file at rest
    bool may_grow = false;                        // later files may have further bodies behind those of the first
    bool any_distance = false;                    // positions are exact far from the origin, too: see origin()
  };

  /// Reads the first file and the one of `rest`. No output may replace any of the files from now on. Throws
  /// MeshFileError, as read() does, if a file cannot be read, and UsageError if it does not match.
  FrameSequence(std::vector<std::filesystem::path> files, const Options& options);

  std::size_t count() const { return files_.size(); }
  BodiesBy by() const { return by_; }
  const std::filesystem::path& file(std::size_t frame) const { return files_[frame]; }
  /// Returns the bodies of the first file.
  const std::shared_ptr<const SequenceBodies>& bodies() const { return first_; }
  /// Reads a frame. Frames with the same bodies share them, unless frames with others were read in between. Bodies that
  /// a frame has in common with the first one, or with the one that was read before, have the same shapes in both.
  SequenceFrame read(std::size_t frame);
  /// Returns the point of the files to which positions are relative, which is near the middle of the first file's
  /// vertices (origin_near()); the files' own origin unless Options::any_distance is set.
  const glm::dvec3& origin() const { return origin_; }
  /// Returns what the authors of the files read so far may have meant differently: of the first file as it is, of
  /// others after the name of the file.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  SequenceFrame read(const std::filesystem::path& file, bool may_grow);
  std::shared_ptr<const SequenceBodies> find(BodyMeshes meshes, const std::filesystem::path& file, bool may_grow);

  std::vector<std::filesystem::path> files_;
  BodiesBy by_;
  bool may_grow_;
  softbody::MeshReading reading_;
  glm::dvec3 origin_{0.0};
  std::shared_ptr<const SequenceBodies> first_, last_;  // of the first file; of the last one read that has more, if any
  std::optional<softbody::Points> first_at_;            // until read(0) returns it
  std::vector<std::string> notes_;
};

}  // namespace app::files
