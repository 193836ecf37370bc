#pragma once
// Exports pictures, recordings and curves of the demo. It knows neither window nor ImGui: the main loop passes the
// pictures in.

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include <glm/vec2.hpp>

#include "app/session/export/frame_writers.h"
#include "app/session/live/live_comparison.h"
#include "app/session/simulation.h"

namespace app::session {

/// A size of pictures to choose from.
struct PictureSize {
  std::string_view name;
  glm::uvec2 pixels;  // 0, 0: as shown
};

class Exporter {
 public:
  /// Returns a picture of the window, with the panel or of the scene alone. `size`: of the scene's picture; nothing: as
  /// shown.
  using Picture = std::function<engine::Image(bool with_panel, const std::optional<glm::uvec2>& size)>;
  static constexpr std::array<PictureSize, 3> sizes{
      {{"As shown", {0, 0}}, {"1920 x 1080", {1920, 1080}}, {"3840 x 2160", {3840, 2160}}}};
  static constexpr std::size_t own = sizes.size();  // the choice of own_size
  static constexpr std::uint32_t min_side = 16, max_side = 8192;

  std::string folder = ".";        // for all files; made if it does not exist
  bool with_panel = false;         // pictures show the panel, too, and are as large as the window
  std::size_t size = 0;            // of pictures and videos: an index of `sizes`, or `own`
  glm::uvec2 own_size{1280, 720};  // pixels, min_side .. max_side
  std::size_t kind = 0;            // of the next recording: an index of recording_kinds()
  bool picture_requested = false;  // take a picture with the next frame

  /// Both must outlive this.
  Exporter(Simulation& simulation, const LiveComparison& comparison)
      : simulation_(simulation), comparison_(comparison) {}
  /// Waits until all frames of a recording are written.
  ~Exporter();

  void write_curves();
  /// Starts a recording, or stops the one in progress.
  void toggle_recording();
  /// Returns true during a recording. Then the world moves one step per picture, so that no frame is lost, and only if
  /// may_step().
  bool recording() const { return recording_ && !progress_.stopping; }
  bool may_step() const { return !recording() || recording_->waiting() < RecordingTask::max_waiting; }
  /// Returns the size of pictures; nothing: as shown.
  std::optional<glm::uvec2> picture_size() const;
  /// Returns true if frame() will ask for a picture as shown.
  bool wants_shown_picture() const {
    return !picture_size() && (picture_requested || (recording() && recorded_->pictures));
  }
  /// Returns true while the last recording is still being written: no other one can start.
  bool finishing() const { return recording_ && progress_.stopping; }

  /// Takes and records pictures. Call it once for each frame of the window, after it is drawn. The notice says what was
  /// written.
  void frame(const Picture& picture);

  /// Returns what was written last or is being written, or what failed.
  const std::string& message() const { return message_; }
  bool failed() const { return failed_; }

 private:
  void attempt(const std::function<std::string()>& action);
  void show_message() { failed_ ? simulation_.notice.set(message_) : simulation_.notice.tell(message_); }
  void record(const Picture& picture);
  void stop(const std::string& error = "");
  void follow_recording();

  Simulation& simulation_;
  const LiveComparison& comparison_;
  std::unique_ptr<Background<RecordingTask>> recording_;
  RecordingProgress progress_;  // of it
  const RecordingKind* recorded_ = nullptr;
  int recorded_frame_ = -1;                         // of the world: each is recorded once
  std::shared_ptr<const files::ObjWriter> bodies_;  // of the last frame recorded
  std::string message_;
  bool failed_ = false;
};

/// Returns the curves of the panel as CSV: a column for each curve, and a line for each frame that some curve has.
std::string curves_csv(const Simulation& simulation, const LiveComparison& comparison);

}  // namespace app::session
