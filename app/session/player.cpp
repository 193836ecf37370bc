#include "app/session/player.h"

#include "app/base/timings.h"
#include "app/session/window_work.h"

namespace app::session {

Player::Player(std::shared_ptr<files::Playback> recording, softbody::Scene scene, int threads)
    : recording_(std::move(recording)),
      scene_(std::move(scene)),
      settings_(settings_of(scene_)),
      method_(collide::find_method(scene_.method)),
      workers_(threads),
      detector_(method_->make()) {
  show(0);
}

void Player::step() {
  report_.total_ms = time_ms([this] {
    tried_ = (tried_ + 1) % recording_->frame_count();
    show(tried_);
  });
  report_.solve_ms = report_.total_ms - report_.detect_ms;
  report_.seconds = frame_time();
  report_.time += frame_time();
}

void Player::show(int number) {
  shown_ = recording_->frame(number);
  frame_ = tried_ = number;
  if (shown_->body_count < bodies_.count()) {
    bodies_ = {};
    detector_->forget();
  }
  while (bodies_.count() < shown_->body_count) bodies_.add(recording_->model(bodies_.count())->shape);
  report_.detect_ms = time_ms([this] { detector_->detect(positions(), settings_, workers_, result_); });
}

/// Returns the automatic cell size for the shapes that the bodies have in the first frame.
glm::vec3 Player::automatic_cell_size(int levels, float tolerance) const {
  const std::shared_ptr<const files::RecordedFrame> first = recording_->frame(0);
  collide::Bodies bodies;
  for (std::uint32_t body = 0; body < first->body_count; ++body) bodies.add(recording_->model(body)->shape);
  return collide::automatic_cell_size({first->x, first->y, first->z, &bodies}, levels, tolerance);
}

collide::Settings Player::settings_of(const softbody::Scene& scene) const {
  collide::Settings all = scene.collision;
  if (!all.cell_size) all.cell_size = automatic_cell_size(all.levels, all.tolerance);
  return all;
}

void Player::apply(const softbody::Scene& scene) {
  if (const std::string wrong = collide::problem(scene.collision); !wrong.empty()) throw softbody::SceneError(wrong);
  const collide::Method& method = *collide::find_method(scene.method);
  collide::Settings settings = settings_of(scene);
  if (&method != method_ || settings != settings_) require_affordable(*this, method, settings);
  auto detector = method.make();
  collide::Result result;
  report_.detect_ms = time_ms([&] { detector->detect(positions(), settings, workers_, result); });
  scene_ = scene;
  method_ = &method;
  settings_ = settings;
  detector_ = std::move(detector);
  result_ = std::move(result);
}

void Player::forget_detection() {
  detector_ = method_->make();
  result_ = {};
}

}  // namespace app::session
