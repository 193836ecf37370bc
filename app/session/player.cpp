#include "app/session/player.h"

#include <cassert>

#include "app/base/timings.h"

namespace app::session {

Player::Player(std::shared_ptr<files::Recording> recording, softbody::Scene scene, int threads)
    : recording_(std::move(recording)),
      scene_(std::move(scene)),
      settings_(scene_.collision),
      method_(collide::find_method(scene_.method)),
      workers_(threads),
      detector_(method_->make()) {
  if (scene_.default_cell_size) settings_.cell_size = default_cell_size(settings_.levels);
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
  detect();
}

void Player::detect() {
  report_.detect_ms = time_ms([this] { detector_->detect(positions(), settings_, workers_, result_); });
}

glm::vec3 Player::default_cell_size(int levels) const {
  return files::default_cell_size(*recording_, levels, settings_.tolerance);
}

void Player::set_method(std::string_view key) {
  method_ = collide::find_method(key);
  assert(method_);
  detector_ = method_->make();
  detect();
}

void Player::set_collision(const collide::Settings& settings, bool default_cell_size) {
  assert(collide::problem(settings).empty());
  settings_ = scene_.collision = settings;
  scene_.default_cell_size = default_cell_size;
  if (default_cell_size) settings_.cell_size = this->default_cell_size(settings.levels);
  detect();
}

void Player::forget_detection() {
  detector_ = method_->make();
  result_ = {};
}

}  // namespace app::session
