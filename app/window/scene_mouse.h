#pragma once
// The mouse over the scene: a drag on a body pulls the body, a drag on a solid moves the solid, a drag on the
// background moves the camera.

#include <array>
#include <optional>

#include "app/render/pick.h"
#include "app/ui/state/requests.h"
#include "app/window/scene_picture.h"
#include "engine/camera.h"

namespace app::window {

/// The mouse since the last picture. Buttons change at the end of its way. Pixels are the framebuffer's; `at` is
/// measured from the viewport's top left corner.
struct MouseInput {
  glm::vec2 at{0.0f}, moved{0.0f};
  std::array<bool, 3> down{};  // left, right, middle
  bool double_click = false;   // of the left button
  float wheel = 0;             // steps
  bool over_scene = true;      // false: a window of the user interface has the mouse
};

/// Returns where bodies are for the mouse. It is valid until the next step.
render::DrawnPositions positions_under_mouse(const Session& session, session::Half half = session::Half::first);

/// Makes the camera glide to a body, or to two vertices, from where as little as possible hides them.
void focus_on(softbody::BodyId body, const Session& session, engine::Camera& camera, glm::ivec2 size);
void focus_on(const collide::Contact& pair, const Session& session, engine::Camera& camera, glm::ivec2 size);

/// Returns Dear ImGui's mouse. `origin`: the viewport's top left corner in the window, framebuffer pixels.
MouseInput read_mouse(glm::vec2 origin, bool over_scene);

class SceneMouse {
 public:
  /// Moves the camera, and returns what the mouse asks for. Call it for each picture, before the camera advances.
  /// `size`: of the viewport.
  ui::Requests update(const MouseInput& input, const Session& session, const ui::UiState& ui, engine::Camera& camera,
                      glm::ivec2 size);

  /// Continues a drag that orbits the camera, to `at`, between two pictures, when the session must not be used.
  void orbit_between_pictures(glm::vec2 at, engine::Camera& camera, glm::ivec2 size);

  /// True if a body or a solid that can be dragged is under the mouse, or is dragged.
  bool can_drag() const { return can_drag_; }
  /// Returns the ray from the eye through the mouse, or through the middle if the mouse is not over the scene.
  engine::Ray ray(const engine::Camera& camera, glm::ivec2 size) const;
  /// Returns the half into whose world that ray goes.
  session::Half half() const { return half_; }

 private:
  /// What the mouse points at: a ray from a camera into the world of a half.
  struct Aim {
    session::Half half;
    engine::Camera camera;
    engine::Ray ray;
  };
  enum class Drag { none, body, solid, orbit };
  struct HeldSolid {
    std::size_t index;           // in the scene
    softbody::Solid solid;       // where it was at the press
    glm::dvec3 point;            // m, where the mouse pressed it
    std::uint64_t world_number;  // of the Simulation
  };

  void press(const MouseInput& input, const Aim& aim, const Session& session, ui::Requests& requests);
  void drag(const MouseInput& input, const Aim& aim, const Session& session, engine::Camera& camera, glm::ivec2 size,
            ui::Requests& requests);
  void release(const Session& session, ui::Requests& requests);

  Drag drag_ = Drag::none;
  std::array<bool, 3> down_{};  // at the last picture
  bool can_drag_ = false, pressed_on_body_ = false;
  std::optional<HeldSolid> held_solid_;
  float drag_length_ = 0;                 // pixels, since the left button went down
  std::optional<session::Half> held_in_;  // the half in which the left button went down, until it goes up
  std::optional<engine::Ray> under_;
  session::Half half_ = session::Half::first;
  glm::vec2 last_at_{0.0f}, orbited_{0.0f};  // pixels; the second is the way of orbit_between_pictures() since update()
};

}  // namespace app::window
