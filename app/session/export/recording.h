#pragma once
// Writes a sequence of frames beside the demo, so that it does not wait.

#include <cassert>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/base/background.h"
#include "app/compare/positions.h"
#include "app/files/obj_writer.h"
#include "engine/image.h"

namespace app::session {

/// A frame of a recording. Each writer uses its own part; the others stay empty.
struct RecordedFrame {
  int number = 0;         // of the world
  engine::Image picture;  // pictures and video
  std::shared_ptr<const files::ObjWriter> bodies;
  compare::Positions positions;  // of the bodies, for their motion
};

class FrameWriter {
 public:
  virtual ~FrameWriter() = default;
  /// Writes a frame. Throws std::exception with one line for the user.
  virtual void write(const RecordedFrame& frame) = 0;
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
  using Question = std::optional<RecordedFrame>;
  using Answer = RecordingProgress;
  explicit RecordingTask(std::unique_ptr<FrameWriter> writer) : writer_(std::move(writer)) {}
  std::optional<RecordingProgress> advance(const Question& frame, const Background<RecordingTask>& background);

 private:
  std::unique_ptr<FrameWriter> writer_;
  RecordingProgress progress_;
};

class FrameRecording {
 public:
  static constexpr std::size_t max_waiting = 4;  // frames in memory

  explicit FrameRecording(std::unique_ptr<FrameWriter> writer, Runs runs = usual_runs)
      : progress_{.name = writer->name(), .error = {}}, task_(runs, std::move(writer)) {}
  /// Waits until all frames are written.
  ~FrameRecording() {
    stop();
    task_.wait();
  }

  /// Returns true if a frame would be taken now. Otherwise the world must wait, so that no frame is lost.
  bool has_room() const { return task_.waiting() < max_waiting; }
  /// Takes a frame. Precondition: stop() was not called.
  void add(RecordedFrame frame) {
    assert(!progress_.stopping);
    task_.offer(std::move(frame));
  }
  /// Ends the recording. Frames that wait are still written. `error`: why there are no more; empty if all went well.
  void stop(std::string error = "");
  /// Returns what has been written. Call it once for each picture.
  const RecordingProgress& update();
  /// Returns the same as the last update(), and whether stop() was called.
  const RecordingProgress& progress() const { return progress_; }

 private:
  RecordingProgress progress_;
  Background<RecordingTask> task_;
};

}  // namespace app::session
