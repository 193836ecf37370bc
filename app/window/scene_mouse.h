#pragma once
// The mouse over the scene: on a body it takes the body, beside all bodies it moves the camera.

#include <array>

#include "app/render/pick.h"
#include "app/session/session.h"
#include "engine/camera.h"

namespace app {

/// One frame's mouse, with a button's change at its end. Pixels are the framebuffer's; `at` from the viewport's top
/// left corner.
struct MouseInput {
  glm::vec2 at{0.0f}, moved{0.0f};
  std::array<bool, 3> down{};  // left, right, middle
  bool double_click = false;   // with the left button, in this frame
  float wheel = 0;             // steps
  bool over_scene = true;      // false: a panel has the mouse
};

/// The camera glides to a body.
void look_at(softbody::BodyId body, const Session& session, engine::Camera& camera, glm::ivec2 size);

/// Dear ImGui's mouse. origin: the viewport's top left corner in the window, framebuffer pixels.
MouseInput read_mouse(glm::vec2 origin, bool over_scene);

class SceneMouse {
 public:
  /// Once a frame, before the camera advances. size: of the viewport.
  void follow(const MouseInput& input, Session& session, engine::Camera& camera, glm::ivec2 size);

  /// For moments between frames, in which there is no session to ask: a drag that turns the camera goes on to `at`.
  void turn_on(glm::vec2 at, engine::Camera& camera, glm::ivec2 size);

  /// A body that could be taken lies under the mouse, or is held.
  bool on_body() const { return on_body_; }
  /// From the eye through the mouse; through the middle while a panel has the mouse.
  engine::Ray ray(const engine::Camera& camera, glm::ivec2 size) const;

 private:
  enum class Drag { nothing, body, turn };

  void press(const MouseInput& input, Session& session, engine::Camera& camera, glm::ivec2 size);
  void drag(const MouseInput& input, Session& session, engine::Camera& camera, glm::ivec2 size);
  void let_go(Session& session);

  Drag drag_ = Drag::nothing;
  std::array<bool, 3> down_{};  // as in the last frame
  bool on_body_ = false, pressed_on_body_ = false;
  float travelled_ = 0;  // pixels, since the left button went down
  std::optional<glm::vec2> at_;
  glm::vec2 last_at_{0.0f}, turned_on_{0.0f};  // pixels: the second by turn_on(), since follow()
};

}  // namespace app
