#pragma once
// An orbit camera: looks at a target from a distance and two angles; +y is up. No OpenGL.

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace engine {

struct Ray {
  glm::vec3 origin, direction;  // direction has length 1
};

/// Where the camera is. Angles in radians.
struct Orbit {
  glm::vec3 target{0.0f};
  float distance = 5.0f;    // m, from the target to the eye
  float azimuth = 0.6f;     // 0: the eye is on the target's +z side; grows towards +x
  float elevation = 0.35f;  // 0: level; positive: the eye is above the target
};

/// Pixels are framebuffer pixels with (0, 0) the top left corner of the viewport; `size` is the viewport's size.
class Camera {
 public:
  static constexpr float max_elevation = 1.55f;  // just below the pole: the picture never flips

  float fov = 0.7f;  // vertical opening angle, radians

  const Orbit& orbit() const { return now_; }
  /// Height of a floor that the eye stays above; nothing: there is none.
  void set_floor(std::optional<float> floor) { floor_ = floor; }
  /// Jumps there (clamped to the limits).
  void set_orbit(const Orbit& orbit);
  /// Jumps to where a sphere just fills the viewport, keeping the angles. Also sets the zoom limits and the depth
  /// range.
  void fit(const glm::vec3& centre, float radius, glm::ivec2 size);
  /// As fit(), but glides there.
  void glide_to_fit(const glm::vec3& centre, float radius, glm::ivec2 size);

  /// Glides to where a sphere fills half of the viewport, keeping the angles and the limits.
  void glide_to(const glm::vec3& centre, float radius, glm::ivec2 size);

  /// Glides there, within the limits.
  void glide_to(const Orbit& orbit) { goal_ = clamped(orbit); }

  // The three motions, by how far the mouse moved (pixels) or the wheel turned. The camera glides after them.
  void rotate(glm::vec2 pixels, glm::ivec2 size);  // a drag over the viewport's height turns half a circle
  void pan(glm::vec2 pixels, glm::ivec2 size);     // what lies at the target's depth follows the cursor
  void zoom(float steps);                          // positive: closer, by 10 % of the distance a step

  /// Moves on by `seconds` of real time. Returns false once nothing moves any more: then the matrices stay equal to the
  /// bit.
  bool advance(double seconds);
  /// Arrives at once.
  void settle() { now_ = goal_; }

  glm::vec3 eye() const;
  glm::mat4 view() const;
  glm::mat4 projection(glm::ivec2 size) const;  // OpenGL clip space
  Ray pick_ray(glm::vec2 pixel, glm::ivec2 size) const;
  /// The pixel of a point in the world and its depth (0 near .. 1 far); nothing if it lies behind the eye.
  std::optional<glm::vec3> project(const glm::vec3& point, glm::ivec2 size) const;

 private:
  Orbit clamped(Orbit orbit) const;
  Orbit fitted(const glm::vec3& centre, float radius, glm::ivec2 size);
  Orbit before(const glm::vec3& centre, float radius, glm::ivec2 size) const;

  Orbit now_, goal_;
  glm::vec3 centre_{0.0f};
  float scene_radius_ = 5.0f;
  std::optional<float> floor_;
};

}  // namespace engine
