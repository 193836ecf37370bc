#include "app/window/scene_mouse.h"

#include <imgui.h>

#include <utility>

#include <glm/geometric.hpp>

namespace app {
namespace {

constexpr float click_travel = 5;  // pixels: whoever moves the mouse further drags

/// Where the ray meets the plane through `point` that faces the camera.
glm::dvec3 beside(const engine::Ray& ray, const engine::Camera& camera, const glm::dvec3& point) {
  const glm::dvec3 ahead = glm::normalize(glm::dvec3(camera.orbit().target) - glm::dvec3(camera.eye()));
  const glm::dvec3 eye(ray.origin), direction(ray.direction);
  return eye + glm::dot(point - eye, ahead) / glm::dot(direction, ahead) * direction;
}

}  // namespace

void look_at(softbody::BodyId body, const Session& session, engine::Camera& camera, glm::ivec2 size) {
  const BoundingSphere sphere = bounding_sphere(session.world(), body, session.drawn_positions());
  camera.glide_to(sphere.centre, sphere.radius, size);
}

MouseInput read_mouse(glm::vec2 origin, bool over_scene) {
  const ImGuiIO& io = ImGui::GetIO();
  const glm::vec2 ratio(io.DisplayFramebufferScale.x, io.DisplayFramebufferScale.y);
  return {.at = glm::vec2(io.MousePos.x, io.MousePos.y) * ratio - origin,
          .moved = glm::vec2(io.MouseDelta.x, io.MouseDelta.y) * ratio,
          .down = {io.MouseDown[0], io.MouseDown[1], io.MouseDown[2]},
          .double_click = io.MouseDoubleClicked[0],
          .wheel = io.MouseWheel,
          .over_scene = over_scene};
}

engine::Ray SceneMouse::ray(const engine::Camera& camera, glm::ivec2 size) const {
  return camera.pick_ray(at_.value_or(0.5f * glm::vec2(size)), size);
}

void SceneMouse::follow(const MouseInput& in, Session& session, engine::Camera& camera, glm::ivec2 size) {
  at_.reset();
  if (in.over_scene) at_ = in.at;
  drag(in, session, camera, size);
  const auto before = std::exchange(down_, in.down);
  if (in.down[0] && !before[0] && in.over_scene) press(in, session, camera, size);
  if (!in.down[0]) let_go(session);
  last_at_ = in.at;
  turned_on_ = {};
  on_body_ = drag_ == Drag::body || (in.over_scene && drag_ == Drag::nothing &&
                                     pick(camera.pick_ray(in.at, size), session.world(), session.drawn_positions()));
}

void SceneMouse::turn_on(glm::vec2 at, engine::Camera& camera, glm::ivec2 size) {
  if (drag_ != Drag::turn) return;
  camera.rotate(at - last_at_, size);
  turned_on_ += at - last_at_;
  last_at_ = at;
}

void SceneMouse::press(const MouseInput& in, Session& session, engine::Camera& camera, glm::ivec2 size) {
  travelled_ = 0;
  drag_ = Drag::turn;
  const auto under = pick(camera.pick_ray(in.at, size), session.world(), session.drawn_positions());
  pressed_on_body_ = under.has_value();
  if (!under) return;
  session.select_body(under->body);
  if (in.double_click) {
    look_at(under->body, session, camera, size);
  } else if (!session.paused) {
    session.grab({.body = under->body,
                  .corners = under->corners,
                  .weights = glm::dvec3(under->weights),
                  .target = glm::dvec3(under->point)});
    drag_ = Drag::body;
  }
}

// By the buttons that were down in the last frame: the way to where one went down is no drag, the way to where it went
// up is.
void SceneMouse::drag(const MouseInput& in, Session& session, engine::Camera& camera, glm::ivec2 size) {
  travelled_ += glm::length(in.moved);
  const auto& held = session.world().grabbed();
  if (drag_ == Drag::body && held) session.pull_to(beside(camera.pick_ray(in.at, size), camera, held->target));
  if (drag_ == Drag::turn) camera.rotate(in.moved - turned_on_, size);
  if (!in.over_scene) return;
  if (down_[1] || down_[2]) camera.pan(in.moved, size);
  if (in.wheel != 0) camera.zoom(in.wheel);
}

void SceneMouse::let_go(Session& session) {
  if (session.world().grabbed()) session.release();
  if (drag_ == Drag::turn && !pressed_on_body_ && travelled_ < click_travel) session.select_body(std::nullopt);
  drag_ = Drag::nothing;
}

}  // namespace app
