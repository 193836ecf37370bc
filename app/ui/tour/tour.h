#pragma once
// The guided tour of the paper's method on the live frame: its state, without a window and without ImGui.

#include "app/render/overlays.h"
#include "app/session/session.h"
#include "app/ui/tour/steps.h"

namespace app::ui {

class Tour {
 public:
  bool open() const { return finder_ != nullptr; }
  /// Pauses the world, saves and clears the overlays, and shows a step. Runs ahead if the frame lacks the step's goal.
  /// The tour must be closed.
  void start(Session& session, render::Overlays& shown, std::size_t step = 0);
  /// Ends a run ahead, resumes the world if the tour paused it, and restores the overlays.
  void close(Session& session, render::Overlays& shown);
  void toggle(Session& session, render::Overlays& shown) { open() ? close(session, shown) : start(session, shown); }

  // These do nothing beyond the first and the last step, or if the tour is closed.
  void back();
  void next();
  std::size_t step() const { return step_; }
  /// Shows one of the eight corners of the hashed box.
  void choose_corner(std::size_t corner);

  /// Lets the world run to a frame that has the goal of the step. Gives up after max_seconds_ahead of simulated time,
  /// or when all bodies are at rest for good. The tour must be open.
  void run_ahead(Session& session);
  /// The goal of the run, while the world runs ahead.
  const TourGoal* running_to(const Session& session) const { return session.run_ahead.active() ? goal_ : nullptr; }
  /// True in the frame in which a run for the goal of this step came to the end of its time.
  bool has_given_up(const Session& session) const;

  /// What the camera should do.
  struct Camera {
    bool overview = false;  // show what it showed before the tour: at the start of each run ahead
    bool framing = false;   // frame the highlight: once after each step
  };
  /// Call it once a frame. Finds a new example if the state or the selected body has changed; prefers one that is
  /// visible in `view`.
  Camera update(const Session& session, const softbody::View* view = nullptr);
  /// Returns nothing while the world runs ahead, if there is no body to show, or if the method cannot be shown on it:
  /// then problem() says why.
  std::optional<TourContext> context(const Session& session) const;
  const std::string& problem() const { return problem_; }
  /// What the step highlights in the scene; nullptr if nothing.
  const render::Highlight* highlight() const { return example_ ? &highlight_ : nullptr; }
  /// A number that changes with the highlight.
  std::uint64_t highlight_revision() const { return highlight_revision_; }

  /// The user's own overlays while the tour is open.
  const std::optional<render::Overlays>& saved_overlays() const { return saved_overlays_; }

 private:
  void find_example(const Session& session, const softbody::View* view);
  void rebuild_highlight(const Session& session);
  void go_to(std::size_t step);

  static constexpr double max_seconds_ahead = 20;

  std::shared_ptr<ExampleFinder> finder_;  // while the tour is open; a run ahead uses it, too
  const TourGoal* goal_ = nullptr;         // of the last run ahead, if there was one ...
  double run_end_ = 0;                     // ... and the simulated time (s) at which it gives up
  std::optional<TourExample> example_;
  std::optional<std::size_t> chosen_corner_;  // none: the example's
  std::string problem_;
  render::Highlight highlight_;
  std::size_t step_ = 0;
  std::uint64_t example_revision_ = 0, highlight_revision_ = 0;  // the first is the session's
  std::optional<softbody::BodyId> example_selection_;            // the selected body when the example was found
  bool highlight_valid_ = false;
  Camera wanted_;  // with the next update(), the framing with the next example
  std::optional<render::Overlays> saved_overlays_;
  std::optional<std::uint32_t> saved_bucket_;
  bool was_paused_ = false;
};

}  // namespace app::ui
