#pragma once
// Keeps the picture of the scene between frames of the window. It is drawn again only if something in it has changed,
// so that a world at rest costs nothing and the panel stays responsive.

#include <cstddef>
#include <functional>
#include <optional>

#include <glm/vec2.hpp>

#include "engine/gl.h"
#include "engine/render/renderer.h"

namespace app::render {

/// The share of the pixels along each side that a moving picture gets: 1 if at least 30 pictures per second come; else
/// less, so that 30 come, but at least 0.55.
class RenderScale {
 public:
  /// Tells of a moving picture: the time since the picture before it, and the time to draw it (both in s).
  void add(double interval, double drawing);
  float value() const;

 private:
  std::size_t level_ = 0;
  int pictures_ = 0;  // since the level was last checked
  double interval_ = 0, drawing_ = 0;
};

class Canvas {
 public:
  using Draw = std::function<void(const engine::Viewport& whole)>;

  /// Requires a current context. in_software: the driver draws in software. Then each pixel takes time, and twice as
  /// much with smooth edges; so moving pictures have no smooth edges, and are coarser if they would come too slowly.
  explicit Canvas(bool in_software) : in_software_(in_software) {}

  /// Calls draw, with a framebuffer bound, if the scene has `changed`, or if a `fine` picture (smooth edges, all
  /// pixels) is wanted and the present one is not. The viewport that draw gets may be smaller than `size`.
  void update(glm::ivec2 size, bool changed, bool fine, const Draw& draw);
  /// Copies the picture to the window, with its lower left corner at `origin`. Precondition: update() was called.
  void show(glm::ivec2 origin) const;
  /// Returns the picture if the last update() wanted a fine one, else perhaps an older one; empty before the first.
  engine::Image read() const { return full_ ? full_->read() : engine::Image{}; }

  /// Tells how long the last picture took, see RenderScale::add(). Only moving pictures count.
  void add_timing(double interval, double drawing);
  /// Returns the render scale of the present picture.
  float render_scale() const { return is_coarse_ ? drawn_at_ : 1.0f; }

 private:
  static constexpr int samples = 4;

  const engine::Framebuffer& coarse(glm::ivec2 size);

  bool in_software_;
  bool is_fine_ = false, is_coarse_ = false, moved_ = false;
  RenderScale render_scale_;
  float drawn_at_ = 1;  // render scale of the last coarse picture
  std::optional<engine::Framebuffer> full_, multisampled_, coarse_;
};

}  // namespace app::render
