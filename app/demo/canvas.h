#pragma once
// The scene's picture, kept between frames of the window. It is drawn again only if something in it has changed, so
// that a world at rest costs nothing and the panel stays quick beside it.

#include <functional>
#include <optional>

#include <glm/vec2.hpp>

#include "engine/gl.h"
#include "engine/renderer.h"

namespace app {

class Canvas {
 public:
  /// Needs a current context. Drivers that draw in software take twice as long with smooth edges: for them moving
  /// pictures do without (`smooth_motion` false), and a still one is drawn once more with them.
  explicit Canvas(bool smooth_motion) : smooth_motion_(smooth_motion) {}

  /// Calls draw with the canvas bound if `changed`, or if the picture is still but not yet smooth.
  void update(glm::ivec2 size, bool changed, bool still, const std::function<void(const engine::Viewport&)>& draw);
  /// Copies the picture to the window, its lower left corner at `origin`.
  void show(glm::ivec2 origin) const;
  /// The picture; empty before the first update().
  engine::Image read() const { return plain_ ? plain_->read() : engine::Image{}; }

 private:
  static constexpr int samples = 4;

  bool smooth_motion_;
  bool is_smooth_ = false;
  std::optional<engine::Framebuffer> plain_, multisampled_;
};

}  // namespace app
