#pragma once
// Writes a sequence of frames on a thread of its own, so that the demo does not wait.

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

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

class FrameRecording {
 public:
  static constexpr std::size_t max_waiting = 4;  // frames in memory

  explicit FrameRecording(std::unique_ptr<FrameWriter> writer);
  /// Waits until all frames are written.
  ~FrameRecording() { stop(); }

  /// Returns true if a frame would be taken now. Otherwise the world must wait, so that no frame is lost.
  bool has_room() const;
  void add(RecordedFrame frame);
  /// Ends the recording. Frames that wait are still written. `error`: why there are no more; empty if all went well.
  void stop(std::string error = "");

  struct Progress {
    int written = 0;
    bool stopping = false, ended = false;
    std::string name, error;  // error: empty if all went well
  };
  Progress progress() const;

 private:
  void work();
  bool next(RecordedFrame& frame);

  std::unique_ptr<FrameWriter> writer_;  // used by the thread alone
  mutable std::mutex mutex_;             // guards the members below
  std::condition_variable wake_;
  std::deque<RecordedFrame> waiting_;
  Progress progress_;
  std::jthread thread_;  // last member: starts after the others are made, and ends before they go
};

}  // namespace app::session
