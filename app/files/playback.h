#pragma once
// A recording in a sequence of mesh files: bodies whose motion is known, frame by frame.

#include <map>
#include <optional>

#include "app/base/background.h"
#include "app/files/frame_sequence.h"
#include "collide/surface/box_tree.h"
#include "softbody/model/body_model.h"
#include "softbody/scene/scene.h"

namespace app::files {

/// A frame of a recording: the first bodies of the recording, and where their vertices are.
/// Points are in the world, one body after another, and finite.
struct RecordedFrame : softbody::Points {
  std::uint32_t body_count = 0;
};

/// Moves frames far from the origin to it, all by the same way, so that floats hold them as exactly as the files do.
/// Reads frames when they are shown, and the next one ahead of time, as a task for Background. The first frames, as
/// many as fit into the memory that a Playback may take, are read only once. Bodies without vertices are left out.
class Playback {
 public:
  static constexpr std::size_t max_kept_bytes = std::size_t{512} << 20;  // of positions
  static constexpr double max_coordinate = 1e15;  // in a file, m; squares of distances must fit into a float

  /// Reads the first frame, and for bounds() one in the middle and the last. by: left out, the default of the first
  /// file's format. in_scene: the frames are floats of a scene and stay where they are. Throws as FrameSequence does,
  /// and SceneError if the first frame cannot be read, has no vertex or one beyond max_coordinate.
  explicit Playback(std::vector<std::filesystem::path> files, std::optional<BodiesBy> by = {},
                    std::size_t kept_bytes = max_kept_bytes, bool in_scene = false);

  /// Returns the lower and the upper corner of a box around the bodies, as far as that is known without all frames.
  std::array<glm::vec3, 2> bounds() const { return {glm::vec3(bounds_.lo), glm::vec3(bounds_.hi)}; }
  /// Returns the number of frames, at least 1.
  int frame_count() const { return static_cast<int>(sequence_.count()); }
  /// Returns a frame. Precondition: 0 <= number < frame_count(). Throws SceneError if it cannot be read;
  /// other frames can be read nevertheless.
  std::shared_ptr<const RecordedFrame> frame(int number);
  /// Returns the model of a body, which is the same in all frames. Precondition: a frame with this body was read.
  const std::shared_ptr<const softbody::BodyModel>& model(std::uint32_t body) const { return models_[body]; }
  /// Frees the memory of frames that can be read again.
  void release();
  /// Returns the words by which a command line names the recording.
  const std::vector<std::string>& command_words() const { return command_words_; }
  /// Returns half the median length of the edges of the first frame, whatever the unit of the files is; without edges,
  /// a hundredth of the diagonal of bounds().
  float usual_tolerance();

 private:
  SequenceFrame read(int number);
  void read_ahead(int number);
  void include(const RecordedFrame& frame);
  std::shared_ptr<const RecordedFrame> record(int number, SequenceFrame frame);

  FrameSequence sequence_;                                    // only for ahead_ while it has work
  std::map<int, std::shared_ptr<const RecordedFrame>> kept_;  // by number; always the first
  std::size_t free_bytes_;                                    // for more of them
  std::vector<std::shared_ptr<const softbody::BodyModel>> models_;
  collide::surface::Box bounds_;
  std::vector<std::string> command_words_;
  SequenceFrame next_;  // that ahead_ reads, and its number
  int next_number_ = -1;
  std::optional<Background<Call>> ahead_;  // last member: its thread ends before the others go
};

/// What is opened: a scene to simulate, or a recording to play.
struct Opened {
  Opened(softbody::Scene s, std::shared_ptr<Playback> r = nullptr) : scene(std::move(s)), recording(std::move(r)) {}

  softbody::Scene scene;                // with a recording: its names, its view and how its contacts are found
  std::shared_ptr<Playback> recording;  // nullptr: the scene is simulated
};

/// Returns the recording in these files. If they are called as those of a recording of this program, and the file of
/// ObjWriter::write_surroundings() lies beside the first, that decides on the solids, the camera, and how contacts are
/// found. Else usual_tolerance() holds, and the camera sees all of bounds(). Throws as Playback does, and SceneError if
/// that file cannot be read.
Opened open_recording(const std::vector<std::filesystem::path>& files, std::optional<BodiesBy> by = {});

}  // namespace app::files
