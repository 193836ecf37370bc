#pragma once
// The guided tour of the paper's method on the live frame: which step is shown, and what for. No window, no ImGui.

#include "app/render/overlays.h"
#include "app/session/session.h"
#include "app/ui/tour/steps.h"

namespace app {

class Tour {
 public:
  bool open() const { return finder_ != nullptr; }
  /// Pauses the world and puts the overlays aside; the first step is shown.
  void start(Session& session, Overlays& shown);
  /// The world goes on if it did before, unless somebody has let it; the overlays are as they were.
  void close(Session& session, Overlays& shown);
  void toggle(Session& session, Overlays& shown) { open() ? close(session, shown) : start(session, shown); }

  // Nothing happens beyond the first and the last step, or if the tour is closed.
  void back();
  void next();
  std::size_t step() const { return step_; }
  /// Of the eight corners of the box that is hashed.
  void choose_corner(std::size_t corner);

  /// Once a frame: looks again if the state or the selected body has changed, for what can be seen in this view.
  void follow(const Session& session, const softbody::View* view = nullptr);
  /// Nothing if there is no body to show, or the method cannot be shown on it: then problem() says why.
  std::optional<TourView> view(const Session& session) const;
  const std::string& problem() const { return problem_; }
  /// What the step shows in the scene; nullptr if nothing.
  const Highlight* highlight() const { return findings_ ? &highlight_ : nullptr; }
  /// Changes with all that the highlight depends on.
  std::uint64_t changes() const { return changes_; }
  /// True once after each step: the camera should frame the highlight.
  bool take_framing() { return findings_ && std::exchange(framing_, false); }

  /// The user's own overlays, which wait for the end of the tour.
  const std::optional<Overlays>& kept_overlays() const { return kept_overlays_; }

 private:
  void find(const Session& session, const softbody::View* view);
  void show(const Session& session);
  void go_to(std::size_t step);

  std::unique_ptr<Finder> finder_;  // while the tour is open
  std::optional<Findings> findings_;
  std::optional<std::size_t> chosen_corner_;  // none: the findings'
  std::string problem_;
  Highlight highlight_;
  std::size_t step_ = 0;
  std::uint64_t revision_ = 0, changes_ = 0;  // revision_: of the findings
  std::optional<softbody::BodyId> wish_;      // likewise
  bool shown_ = false, framing_ = false;
  std::optional<Overlays> kept_overlays_;
  std::optional<std::uint32_t> kept_bucket_;
  bool was_paused_ = false;
};

}  // namespace app
