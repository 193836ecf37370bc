// Session: what hands do to the world.

#include <algorithm>

#include <glm/geometric.hpp>

#include "app/session/session.h"

namespace app {

using softbody::BodyId;

void Session::select_body(std::optional<BodyId> body) {
  selected_body_ = body && *body < world_->bodies().count() ? body : std::nullopt;
  if (selected_body_) notice_.clear();
}

void Session::grab(const softbody::Grab& grab) {
  world_->grab(grab);
  as_scripted_ = false;
  intervened();
  ++revision_;
}

void Session::pull_to(const glm::dvec3& target) {
  std::optional<softbody::Grab> grab = world_->grabbed();
  if (!grab) return;
  grab->target = target;
  world_->grab(grab);
}

void Session::release() { world_->grab({}); }

/// But for the hand that may hold a body: nobody will be there to let go.
Session::Past Session::as_it_is() const {
  softbody::Snapshot present = world_->snapshot();
  present.grab.reset();
  return {nullptr, std::move(present), scene_, scene_file_, solids_};
}

void Session::drop(int count) {
  if (!can_drop()) return;
  notice_.clear();
  as_scripted_ = false;
  Past present = as_it_is();
  if (succeeds([&] { world_->drop(count); })) remember(std::move(present));
  intervened();
  ++revision_;
}

void Session::throw_body(const glm::dvec3& eye, const glm::dvec3& direction) {
  if (!can_drop()) return;
  notice_.clear();
  as_scripted_ = false;
  Past present = as_it_is();
  std::optional<BodyId> body;
  const bool done = succeeds([&] { body = world_->throw_body(eye, throw_speed * direction); });
  if (body) {
    remember(std::move(present));
    select_body(body);
  }
  if (done && !body) notice_ = "there is no room for a body before the camera: turn or move it";
  intervened();
  if (done) ++revision_;
}

void Session::remove_selected() {
  if (!selected_body_) {
    notice_ = "click a body first, then delete it";
    return;
  }
  notice_.clear();
  as_scripted_ = false;
  Past present = as_it_is();
  world_->grab({});
  if (succeeds([&] { world_->remove(*selected_body_); })) remember(std::move(present));
  selected_body_.reset();
  intervened();
  show_anew();
}

void Session::try_change(const std::function<void()>& change) {
  notice_.clear();
  try {
    change();
  } catch (const softbody::SceneError& error) {
    notice_ = error.what();
  }
  intervened();
  ++revision_;
}

void Session::set_gravity(double strength) {
  const double length = glm::length(scene_.gravity);
  const glm::dvec3 direction = length > 0 ? scene_.gravity / length : glm::dvec3(0, -1, 0);
  try_change([&] { world_->set_gravity(strength * direction); });
}

void Session::set_material(std::size_t index, const softbody::Material& material) {
  try_change([&] { world_->set_material(index, material); });
}

void Session::set_solids(const SolidList& solids) {
  solids_ = solids;
  softbody::Scene scene = world_->scene();
  put_solids(solids, scene);
  try_change([&] { world_->set_solids(scene); });
}

void Session::restore_world_settings() {
  try_change([&] {
    world_->set_gravity(scene_.gravity);
    solids_ = list_solids(scene_);
    world_->set_solids(scene_);
    for (std::size_t i = 0; i < world_->scene().materials.size(); ++i) world_->set_material(i, scene_.materials[i]);
  });
}

/// Where the world has other gravity, solids or materials than those in use, it gets these.
void Session::keep_world_settings(const softbody::Scene& in_use) {
  const softbody::Scene& now = world_->scene();
  if (now.gravity != in_use.gravity) world_->set_gravity(in_use.gravity);
  if (list_solids(now) != list_solids(in_use)) world_->set_solids(in_use);
  for (std::size_t i = 0; i < std::min(now.materials.size(), in_use.materials.size()); ++i)
    if (!(now.materials[i] == in_use.materials[i])) world_->set_material(i, in_use.materials[i]);
}

void Session::undo() {
  if (past_.empty()) return;
  Past past = std::move(past_.back());
  past_.pop_back();
  scene_ = std::move(past.scene);
  scene_file_ = std::move(past.file);
  if (past.world) {
    solids_ = std::move(past.solids);
    world_ = std::move(past.world);
    return begin();
  }
  notice_.clear();
  restore(*past.snapshot);  // later worlds are gone again: it is the one of the snapshot
  went_back();
}

}  // namespace app
