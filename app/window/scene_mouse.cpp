#include "app/window/scene_mouse.h"

#include <imgui.h>

#include <utility>

#include <glm/geometric.hpp>

#include "app/ui/state/ui_state.h"

namespace app::window {
namespace {

constexpr float max_click_length = 5;  // pixels: a longer way of the mouse is a drag

/// Returns the first solid that the ray meets, if it can be dragged: not where recorded bodies have met it.
std::optional<render::SolidPick> pick_movable(const engine::Ray& ray, const Session& session) {
  constexpr double max_distance = 1000;  // m
  const softbody::Scene& scene = session.world().scene();
  if (!session.simulated()) return std::nullopt;
  const auto first = render::pick_solid(ray, scene, max_distance);
  return first && scene.solids[first->index].traits().half_space ? std::nullopt : first;
}

/// Returns the point where the ray meets the plane through `point` that faces the camera.
glm::dvec3 on_facing_plane(const engine::Ray& ray, const engine::Camera& camera, const glm::dvec3& point) {
  const glm::dvec3 ahead = glm::normalize(glm::dvec3(camera.orbit().target) - glm::dvec3(camera.eye()));
  const glm::dvec3 eye(ray.origin), direction(ray.direction);
  return eye + glm::dot(point - eye, ahead) / glm::dot(direction, ahead) * direction;
}

}  // namespace

render::DrawnPositions positions_under_mouse(const Session& session, session::Half half) {
  return drawn_meshes(session, between(session.simulation), half).shown;
}

void focus_on(softbody::BodyId body, const Session& session, engine::Camera& camera, glm::ivec2 size) {
  const render::BoundingSphere sphere = render::bounding_sphere(session.world(), body, positions_under_mouse(session));
  camera.glide_to(sphere.centre, sphere.radius, size);
}

void focus_on(const collide::Contact& pair, const Session& session, engine::Camera& camera, glm::ivec2 size) {
  constexpr float around = 4;  // mean edges
  const render::DrawnPositions at = positions_under_mouse(session);
  const softbody::BodyModel& model = session.world().model(session.world().bodies().body_of(pair.a));
  const float radius = std::max({0.5f * glm::distance(at[pair.a], at[pair.b]), session.world().collision().tolerance,
                                 around * static_cast<float>(model.shown().mean_edge)});
  engine::Camera trial = camera;
  trial.glide_to(0.5f * (at[pair.a] + at[pair.b]), radius, size);
  trial.finish_glide();
  const engine::Orbit ahead = trial.orbit();
  engine::Orbit best = ahead;
  float best_free = 0;  // m from the eye, in which nothing hides the pair
  for (const float elevation : {ahead.elevation, 0.8f, 1.3f})
    for (int turn = 0; turn < 6; ++turn) {
      trial.set_orbit({ahead.target, ahead.distance, ahead.azimuth + static_cast<float>(turn), elevation});
      const engine::Ray ray{trial.eye(), glm::normalize(ahead.target - trial.eye())};
      const float free = std::min(render::distance_to_scene(ray, session.world(), at).value_or(ahead.distance),
                                  ahead.distance - radius);
      if (free > best_free) best = trial.orbit(), best_free = free;
    }
  camera.glide_to(best);
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
  return under_.value_or(camera.pick_ray(0.5f * glm::vec2(size), size));
}

ui::Requests SceneMouse::update(const MouseInput& in, const Session& session, const ui::UiState& ui,
                                engine::Camera& camera, glm::ivec2 size) {
  const std::vector<HalfPicture> parts = halves(scene_picture(session, ui, camera, 1), {{0, 0}, size});
  const float line = static_cast<float>(parts.back().viewport.origin.x);
  const bool at_right = held_in_ ? *held_in_ == session::Half::second : in.at.x >= line;
  const HalfPicture& part = at_right ? parts.back() : parts.front();
  const glm::vec2 at(in.at.x - static_cast<float>(part.viewport.origin.x), in.at.y);
  const Aim aim{part.half, part.camera, part.camera.pick_ray(at, part.viewport.size)};
  ui::Requests requests;
  under_.reset();
  if (in.over_scene) under_ = aim.ray;
  half_ = in.over_scene ? aim.half : session::Half::first;
  drag(in, aim, session, camera, size, requests);
  const auto before = std::exchange(down_, in.down);
  if (in.down[0] && !before[0] && in.over_scene) press(in, aim, session, requests);
  if (!in.down[0]) release(session, requests);
  last_at_ = in.at;
  orbited_ = {};
  const auto something_under = [&] {
    return render::pick(aim.ray, session.simulation.world(aim.half), positions_under_mouse(session, aim.half)) ||
           pick_movable(aim.ray, session);
  };
  can_drag_ =
      drag_ == Drag::body || drag_ == Drag::solid || (drag_ == Drag::none && in.over_scene && something_under());
  return requests;
}

void SceneMouse::orbit_between_pictures(glm::vec2 at, engine::Camera& camera, glm::ivec2 size) {
  if (drag_ != Drag::orbit) return;
  camera.rotate(at - last_at_, size);
  orbited_ += at - last_at_;
  last_at_ = at;
}

void SceneMouse::press(const MouseInput& in, const Aim& aim, const Session& session, ui::Requests& requests) {
  drag_length_ = 0;
  drag_ = Drag::orbit;
  held_in_ = aim.half;
  const engine::Ray& ray = aim.ray;
  auto under = render::pick(ray, session.simulation.world(aim.half), positions_under_mouse(session, aim.half));
  if (under && under->body >= session.world().bodies().count()) under.reset();  // the first half has stopped without it
  pressed_on_body_ = under.has_value();
  if (!under) {
    if (const auto solid = pick_movable(ray, session)) {
      drag_ = Drag::solid;
      ask(requests, [index = solid->index](ui::UiState& ui) { ui.show_solid(index); });
      held_solid_ = {solid->index, session.world().scene().solids[solid->index],
                     glm::dvec3(ray.origin) + solid->distance * glm::dvec3(ray.direction),
                     session.simulation.world_number()};
    }
    return;
  }
  ask(requests, [body = under->body](Session& s) { s.bodies.select(body); });
  if (in.double_click) {
    ask(requests, ui::WindowTask::show_selected_body);
  } else if (!session.simulation.clock.paused && session.simulated()) {
    softbody::Grab grab{.body = under->body,
                        .corners = under->corners,
                        .weights = glm::dvec3(under->weights),
                        .target = glm::dvec3(under->point)};
    // The hand is the first world's; the other's holds the same point of the body.
    if (aim.half == session::Half::second) grab.target = session::held_point(*session.simulated(), grab);
    ask(requests, [grab](Session& s) { s.simulation.grab(grab); });
    drag_ = Drag::body;
  }
}

// A button goes down or up at the end of the way. With the buttons before it, the way to a press is no drag, and the
// way to a release is one.
void SceneMouse::drag(const MouseInput& in, const Aim& aim, const Session& session, engine::Camera& camera,
                      glm::ivec2 size, ui::Requests& requests) {
  drag_length_ += glm::length(in.moved);
  if (drag_length_ >= max_click_length) {  // a click moves nothing
    const auto held = grabbed(session.simulation);
    if (drag_ == Drag::body && held) {
      const session::Beside* beside = session.simulation.beside();
      const glm::dvec3 apart = beside && aim.half == session::Half::second ? beside->hands_apart() : glm::dvec3(0.0);
      ask(requests, [to = on_facing_plane(aim.ray, aim.camera, held->target + apart) - apart](Session& s) {
        s.simulation.pull_to(to);
      });
    }
    // In another world the solids may be others.
    if (drag_ == Drag::solid && session.simulation.world_number() == held_solid_->world_number) {
      const glm::dvec3 way = on_facing_plane(aim.ray, aim.camera, held_solid_->point) - held_solid_->point;
      ask(requests, [index = held_solid_->index, solid = session::moved(held_solid_->solid, way)](Session& s) {
        s.settings.set_solid(index, solid);
      });
    }
  }
  if (drag_ == Drag::orbit) camera.rotate(in.moved - orbited_, size);
  if (!in.over_scene) return;
  if (down_[1]) camera.pan(in.moved, size);
  if (down_[2]) camera.rotate(in.moved, size);  // also over bodies
  if (in.wheel != 0) camera.zoom(in.wheel);
}

void SceneMouse::release(const Session& session, ui::Requests& requests) {
  if (grabbed(session.simulation)) ask(requests, [](Session& s) { s.simulation.release(); });
  held_in_.reset();
  const bool on_scenery = drag_ == Drag::solid || (drag_ == Drag::orbit && !pressed_on_body_);
  if (on_scenery && drag_length_ < max_click_length) ask(requests, [](Session& s) { s.bodies.select(std::nullopt); });
  drag_ = Drag::none;
}

}  // namespace app::window
