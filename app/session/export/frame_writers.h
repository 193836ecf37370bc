#pragma once
// A kind of recordings, and the task that writes one beside the demo.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "app/base/background.h"
#include "app/compare/positions.h"
#include "app/files/obj_writer.h"
#include "engine/image.h"

namespace app::session {

/// A frame of a recording. Each writer uses its own part; the others stay empty.
struct ExportedFrame {
  int number = 0;         // of the world
  engine::Image picture;  // pictures and video
  std::shared_ptr<const files::ObjWriter> bodies;
  compare::Positions positions;  // of the bodies, for their motion
};

class FrameWriter {
 public:
  virtual ~FrameWriter() = default;
  /// Writes a frame. Throws std::exception with one line for the user.
  virtual void write(const ExportedFrame& frame) = 0;
  /// Completes the result after the last frame. Without this call no incomplete file has the final name.
  virtual void finish() {}
  /// Returns the folder or file that is being written, for the user.
  virtual std::string name() const = 0;
};

struct RecordingProgress {
  int written = 0;
  bool stopping = false, ended = false;
  std::string name, error;  // error: empty if all went well
};

/// Writes a frame. A question without a frame completes the recording. A task for Background.
class RecordingTask {
 public:
  using Question = std::optional<ExportedFrame>;
  using Answer = RecordingProgress;
  static constexpr std::size_t max_waiting = 4;  // frames in memory

  explicit RecordingTask(std::unique_ptr<FrameWriter> writer) : writer_(std::move(writer)) {}
  std::optional<RecordingProgress> advance(const Question& frame, const Background<RecordingTask>& background);

 private:
  std::unique_ptr<FrameWriter> writer_;
  RecordingProgress progress_;
};

/// Make a writer whose folder or file has the next free name in `folder`. They throw UsageError.
std::unique_ptr<FrameWriter> make_picture_writer(const std::filesystem::path& folder);
std::unique_ptr<FrameWriter> make_video_writer(const std::filesystem::path& folder);
std::unique_ptr<FrameWriter> make_motion_writer(const std::filesystem::path& folder);

/// A row of recording_kinds() (system_files.h), over which the panel and the tests loop.
struct RecordingKind {
  std::string_view key, name, tooltip;
  bool pictures;  // consists of pictures, else of bodies
  std::unique_ptr<FrameWriter> (*make)(const std::filesystem::path& folder);
};

}  // namespace app::session
