#include "app/ui/tour/tour.h"

#include <cmath>

#include <glm/trigonometric.hpp>

namespace app {
namespace {

glm::dvec3 eye_of(const softbody::View& view) {
  const double round = glm::radians(view.azimuth), up = glm::radians(view.elevation);
  const glm::dvec3 direction(std::cos(up) * std::sin(round), std::sin(up), std::cos(up) * std::cos(round));
  return view.target + view.distance * direction;
}

}  // namespace

void Tour::start(Session& session, Overlays& shown) {
  finder_ = std::make_unique<Finder>();
  was_paused_ = session.paused;
  session.paused = true;
  kept_overlays_ = std::exchange(shown, {});
  kept_bucket_ = session.selected_bucket();
  session.select_bucket(std::nullopt);
  revision_ = 0;
  chosen_corner_.reset();
  go_to(0);
}

void Tour::close(Session& session, Overlays& shown) {
  if (!open()) return;
  finder_.reset();
  findings_.reset();
  if (session.paused) session.paused = was_paused_;
  shown = *std::exchange(kept_overlays_, std::nullopt);
  session.select_bucket(kept_bucket_);
  ++changes_;
}

void Tour::go_to(std::size_t step) {
  step_ = step;
  shown_ = false;
  framing_ = true;
}

void Tour::back() {
  if (open() && step_ > 0) go_to(step_ - 1);
}

void Tour::next() {
  if (open() && step_ + 1 < tour_steps().size()) go_to(step_ + 1);
}

void Tour::choose_corner(std::size_t corner) {
  chosen_corner_ = corner;
  go_to(step_);
}

void Tour::follow(const Session& session, const softbody::View* view) {
  if (!open()) return;
  if (revision_ != session.revision() || wish_ != session.selected_body()) find(session, view);
  if (!shown_) show(session);
}

void Tour::find(const Session& session, const softbody::View* view) {
  revision_ = session.revision();
  wish_ = session.selected_body();
  shown_ = false;
  problem_ = "There is no body in the world yet: close the tour and wait until one comes.";
  try {
    findings_ =
        finder_->find(session.world(), session.selected_body(), view ? std::optional(eye_of(*view)) : std::nullopt);
  } catch (const std::exception& error) {
    findings_.reset();
    problem_ = error.what();
  }
}

void Tour::show(const Session& session) {
  shown_ = true;
  ++changes_;
  highlight_ = {};
  if (const auto now = view(session)) tour_steps()[step_].show(*now, highlight_);
}

std::optional<TourView> Tour::view(const Session& session) const {
  if (!findings_) return std::nullopt;
  return TourView{session.world(), *findings_, chosen_corner_.value_or(findings_->corner)};
}

}  // namespace app
