#pragma once
// The scene's picture, kept between frames of the window. It is drawn again only if something in it has changed, so
// that a world at rest costs nothing and the panel stays quick beside it.

#include <cstddef>
#include <functional>
#include <optional>

#include <glm/vec2.hpp>

#include "engine/gl.h"
#include "engine/renderer.h"

namespace app {

/// How many of its pixels along each side a moving picture gets: all, or where fewer than 30 pictures a second come as
/// many as let them come, but never less than 55 %.
class RenderScale {
 public:
  /// After each moving picture: s from the one before it to this one, and s that drawing took.
  void add(double interval, double drawing);
  float value() const;

 private:
  std::size_t level_ = 0;
  int pictures_ = 0;  // since the level was last looked at
  double interval_ = 0, drawing_ = 0;
};

class Canvas {
 public:
  using Draw = std::function<void(const engine::Viewport& whole)>;

  /// Needs a current context. Drivers that draw in software (`in_software`) take time for each pixel, and twice as long
  /// with smooth edges: for them moving pictures do without, and are coarser where they would come too slowly.
  explicit Canvas(bool in_software) : in_software_(in_software) {}

  /// Calls draw with a picture bound if `changed`, or if the one at hand is not `fine`, with smooth edges and all
  /// pixels, but should be. What draw is told to draw into may be smaller than `size`.
  void update(glm::ivec2 size, bool changed, bool fine, const Draw& draw);
  /// Copies the picture to the window, its lower left corner at `origin`.
  void show(glm::ivec2 origin) const;
  /// The picture, if the last update() wanted it fine; else it may be an older one. Empty before the first.
  engine::Image read() const { return full_ ? full_->read() : engine::Image{}; }

  /// How the last picture came, see RenderScale::add(): one that moved tells how the next ones are to be drawn.
  void pace(double interval, double drawing);
  /// Of the picture at hand.
  float render_scale() const { return is_coarse_ ? drawn_at_ : 1.0f; }

 private:
  static constexpr int samples = 4;

  const engine::Framebuffer& coarse(glm::ivec2 size);

  bool in_software_;
  bool is_fine_ = false, is_coarse_ = false, moved_ = false;
  RenderScale render_scale_;
  float drawn_at_ = 1;  // of the last coarse picture
  std::optional<engine::Framebuffer> full_, multisampled_, coarse_;
};

}  // namespace app
