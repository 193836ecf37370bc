#include "app/ui/tour/tour.h"

#include <cassert>
#include <cmath>

#include <glm/trigonometric.hpp>

namespace app::ui {
namespace {

glm::dvec3 eye_position(const softbody::View& view) {
  const double round = glm::radians(view.azimuth), up = glm::radians(view.elevation);
  const glm::dvec3 direction(std::cos(up) * std::sin(round), std::sin(up), std::cos(up) * std::cos(round));
  return view.target + view.distance * direction;
}

}  // namespace

void Tour::start(Session& session, render::Overlays& shown, std::size_t step) {
  assert(!open() && step < tour_steps().size());
  finder_ = std::make_shared<ExampleFinder>();
  was_paused_ = session.simulation.clock.paused;
  session.simulation.clock.paused = true;
  saved_overlays_ = std::exchange(shown, {});
  saved_bucket_ = session.inspector.selected_bucket();
  session.inspector.select_bucket(std::nullopt);
  go_to(step);
  run_ahead(session);
}

void Tour::close(Session& session, render::Overlays& shown) {
  if (!open()) return;
  session.run_ahead.stop();
  finder_.reset();
  example_.reset();
  goal_ = nullptr;
  if (session.simulation.clock.paused) session.simulation.clock.paused = was_paused_;
  shown = *std::exchange(saved_overlays_, std::nullopt);
  session.inspector.select_bucket(saved_bucket_);
  ++highlight_revision_;
}

void Tour::go_to(std::size_t step) {
  step_ = step;
  highlight_valid_ = false;
  wanted_.framing = true;
}

void Tour::back() {
  if (open() && step_ > 0) go_to(step_ - 1);
}

void Tour::next() {
  if (open() && step_ + 1 < tour_steps().size()) go_to(step_ + 1);
}

void Tour::choose_corner(std::size_t corner) {
  assert(corner < std::tuple_size_v<decltype(TourExample::corners)>);
  chosen_corner_ = corner;
  go_to(step_);
}

void Tour::run_ahead(Session& session) {
  assert(open());
  goal_ = &tour_steps()[step_].goal;
  run_end_ = session.world().last_step().time + max_seconds_ahead;
  chosen_corner_.reset();
  example_.reset();
  example_revision_ = 0;
  wanted_ = {.overview = true, .framing = true};
  session.run_ahead.start([finder = finder_, frame_has = goal_->frame_has](
                              const softbody::BodiesInMotion& world) { return (finder.get()->*frame_has)(world); },
                          max_seconds_ahead);
}

bool Tour::has_given_up(const Session& session) const {
  const double late = session.world().last_step().time - run_end_;
  return goal_ == &tour_steps()[step_].goal && late >= 0 && late < session.world().frame_time();
}

Tour::Camera Tour::update(const Session& session, const softbody::View* view) {
  if (open() && !running_to(session)) {
    if (example_revision_ != session.simulation.revision() || example_selection_ != session.bodies.selected())
      find_example(session, view);
    if (!highlight_valid_) rebuild_highlight(session);
  }
  return {.overview = std::exchange(wanted_.overview, false),
          .framing = example_ && std::exchange(wanted_.framing, false)};
}

void Tour::find_example(const Session& session, const softbody::View* view) {
  example_revision_ = session.simulation.revision();
  example_selection_ = session.bodies.selected();
  highlight_valid_ = false;
  problem_ = "There is no body in the world. The key D drops one.";
  try {
    example_ = finder_->find(session.world(), session.bodies.selected(),
                             view ? std::optional(eye_position(*view)) : std::nullopt);
  } catch (const std::exception& error) {
    example_.reset();
    problem_ = error.what();
  }
}

void Tour::rebuild_highlight(const Session& session) {
  highlight_valid_ = true;
  ++highlight_revision_;
  highlight_ = {};
  if (const auto now = context(session)) tour_steps()[step_].highlight(*now, highlight_);
}

std::optional<TourContext> Tour::context(const Session& session) const {
  if (!example_) return std::nullopt;
  return TourContext{session.world(), *example_, chosen_corner_};
}

}  // namespace app::ui
