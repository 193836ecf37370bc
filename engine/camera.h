#pragma once
// An orbit camera: it looks at a target from a distance, at two angles; +y is up. No OpenGL.

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace engine {

struct Ray {
  glm::vec3 origin, direction;  // direction has length 1
};

/// Position of an orbit camera. Angles in radians.
struct Orbit {
  glm::vec3 target{0.0f};
  float distance = 5.0f;    // m, from the target to the eye
  float azimuth = 0.6f;     // 0: the eye is on the target's +z side; grows towards +x
  float elevation = 0.35f;  // 0: level; positive: the eye is above the target

  bool operator==(const Orbit&) const = default;
};

/// Pixels are framebuffer pixels from the top left corner of the viewport; `size` is the size of the viewport in
/// pixels. A motion changes the goal of the camera; advance() then glides towards this goal.
class Camera {
 public:
  static constexpr float max_elevation = 1.55f;  // just below the pole, where the picture would flip

  float fov = 0.7f;  // vertical field of view, radians

  bool operator==(const Camera&) const = default;

  const Orbit& orbit() const { return current_; }
  /// Keeps the eye above a floor at this height (m); empty: no floor.
  void set_floor(std::optional<float> height) { floor_ = height; }
  /// Jumps to `orbit`, clamped to the limits.
  void set_orbit(const Orbit& orbit);
  /// Jumps to where the sphere just fills the viewport; keeps the angles. Derives the zoom limits and the depth range
  /// from the sphere.
  void fit(const glm::vec3& centre, float radius, glm::ivec2 size);
  /// Glides to where the sphere fills half of the viewport; keeps the angles, the limits and the depth range.
  void glide_to(const glm::vec3& centre, float radius, glm::ivec2 size);
  /// Glides back from the target until the sphere is in the picture, too, if it is not; keeps target and angles.
  void glide_back_to_show(const glm::vec3& centre, float radius, glm::ivec2 size);
  /// Jumps to `factor` times the distance. A glide goes on, to so many times its distance.
  void scale_distance(float factor);
  /// Glides to `orbit`, clamped to the limits.
  void glide_to(const Orbit& orbit) { goal_ = clamped(orbit); }

  // `pixels` is the motion of the mouse, `steps` that of the wheel.
  void rotate(glm::vec2 pixels, glm::ivec2 size);  // a drag over the height of the viewport turns by half a circle
  void pan(glm::vec2 pixels, glm::ivec2 size);     // a point at the target's depth follows the cursor
  void zoom(float steps);                          // positive: 10 % nearer per step

  /// Glides on for `seconds` of real time. Returns false if the camera is at rest: then it returns bit-equal matrices
  /// until the next motion.
  bool advance(double seconds);
  /// Ends the glide at its goal.
  void finish_glide() { current_ = goal_; }

  glm::vec3 eye() const;
  glm::mat4 view() const;
  glm::mat4 projection(glm::ivec2 size) const;  // to OpenGL's clip space
  Ray pick_ray(glm::vec2 pixel, glm::ivec2 size) const;
  /// Returns the pixel of a point in the world (xy) and its depth (z: 0 near .. 1 far); nothing if the point is behind
  /// the eye.
  std::optional<glm::vec3> project(const glm::vec3& point, glm::ivec2 size) const;

 private:
  Orbit clamped(Orbit orbit) const;
  Orbit fitting_orbit(const glm::vec3& centre, float radius, glm::ivec2 size) const;

  Orbit current_, goal_;
  // The sphere of the last fit: limits and depth range follow it.
  glm::vec3 scene_centre_{0.0f};
  float scene_radius_ = 5.0f;
  std::optional<float> floor_;
};

}  // namespace engine
