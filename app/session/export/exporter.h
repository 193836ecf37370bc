#pragma once
// What leaves the demo: a picture, a recording, the curves. No window and no ImGui: the main loop hands the pictures
// in.

#include <functional>
#include <memory>
#include <optional>

#include "app/session/export/frame_writers.h"
#include "app/session/session.h"

namespace app {

class Exporter {
 public:
  /// Of the window as it is; with the panel, or the scene alone.
  using Picture = std::function<engine::Image(bool with_panel)>;

  std::string folder = ".";    // where all of it goes; made if it is not there
  bool with_panel = false;     // pictures show the panel too
  std::size_t kind = 0;        // of the next recording: an index into recording_kinds
  bool picture_asked = false;  // with the next frame

  void write_curves(const Session& session);
  /// Begins a recording, or ends the one in progress.
  void toggle_recording();
  /// Then the world moves by one step a frame, so that the recording misses none, but only if it may_step().
  bool recording() const { return recording_ && !recording_->progress().stopping; }
  bool may_step() const { return recording_->has_room(); }
  /// frame() will ask for one.
  bool wants_picture() const { return picture_asked || (recording() && recorded_->pictures); }
  /// The last recording is still being written: there cannot be another one yet.
  bool finishing() const { return recording_ && recording_->progress().stopping; }

  /// Once a frame of the window, when it is drawn.
  void frame(const Session& session, const Picture& picture);

  /// What was written last, or is being written; or what went wrong.
  const std::string& message() const { return message_; }
  bool failed() const { return failed_; }

 private:
  void attempt(const std::function<std::string()>& action);
  void write_picture(const Picture& picture);
  void record(const Session& session, const Picture& picture);
  void follow_recording();

  std::unique_ptr<FrameRecording> recording_;
  const RecordingKind* recorded_ = nullptr;
  int recorded_frame_ = -1;                  // of the world, which is recorded once
  std::shared_ptr<const ObjWriter> bodies_;  // of the last frame recorded
  std::string message_;
  bool failed_ = false;
};

/// The curves of the panel as CSV: a line for each frame of the world that any of them knows, a column each.
std::string curves_csv(const Session& session);

}  // namespace app
