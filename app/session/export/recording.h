#pragma once
// A sequence that is written beside the demo: frames go in, a thread of their own writes them, nobody waits.

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "app/compare/positions.h"
#include "app/files/obj_writer.h"
#include "engine/image.h"

namespace app {

/// What a recording may be made of: each writer uses its own part, and the others stay empty.
struct RecordedFrame {
  int number = 0;         // of the world
  engine::Image picture;  // pictures and video
  std::shared_ptr<const ObjWriter> bodies;
  Positions positions;  // of the bodies, for their motion
};

class FrameWriter {
 public:
  virtual ~FrameWriter() = default;
  /// Throws std::exception with one line for the user.
  virtual void write(const RecordedFrame& frame) = 0;
  /// After the last frame: makes the result complete. Without it nothing half done stays under its final name.
  virtual void finish() {}
  /// What is being written, for the user: a folder or a file.
  virtual std::string name() const = 0;
};

class FrameRecording {
 public:
  static constexpr std::size_t max_waiting = 4;  // frames in memory

  explicit FrameRecording(std::unique_ptr<FrameWriter> writer);
  /// Waits until all frames are written.
  ~FrameRecording() { stop(); }

  /// Whether a frame would be taken now; the world waits meanwhile, so that no frame is lost.
  bool has_room() const;
  void add(RecordedFrame frame);
  /// No more frames come. Those that wait are still written.
  void stop();

  struct Progress {
    int written = 0;
    std::size_t waiting = 0;
    bool stopping = false, ended = false;
    std::string name, error;  // error: empty if all went well
  };
  Progress progress() const;

 private:
  void work();
  bool next(RecordedFrame& frame);

  std::unique_ptr<FrameWriter> writer_;  // of the thread's
  mutable std::mutex mutex_;             // guards the members below
  std::condition_variable wake_;
  std::deque<RecordedFrame> waiting_;
  Progress progress_;
  std::jthread thread_;  // last: started after, joined before all else
};

}  // namespace app
