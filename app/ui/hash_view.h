#pragma once
// The hash table itself: one square a bucket, its load as colour. A click shows the bucket's boxes in the scene.

#include "app/session/session.h"
#include "app/ui/widgets/hash_grid.h"
#include "app/ui/widgets/widgets.h"

namespace app {

class HashView {
 public:
  /// Draws the view into the current window; `open` becomes false when it is closed.
  void draw(Widgets& widgets, Session& session, bool& open);

  /// Where the squares of the last frame were; tests aim by it.
  const HashGrid& grid() const { return grid_; }
  ImVec2 grid_origin() const { return origin_; }

 private:
  struct Square {
    std::uint32_t load = 0, fullest = 0;  // the load of the fullest bucket in the square, and which one it is
  };

  void refresh(const Session& session, float room, float height, float least_side);
  void draw_squares(Widgets& widgets, Session& session, float room, float height);
  void draw_legend(Widgets& widgets) const;
  glm::vec3 colour(std::uint32_t load) const;
  void draw_summary(const Session& session) const;

  HashGrid grid_;
  ImVec2 origin_{0, 0};
  std::vector<Square> squares_;
  std::uint64_t revision_ = 0;   // of the session when squares_ were gathered
  std::uint32_t full_load_ = 8;  // the end of the colour scale: a power of two, so that it stays
};

}  // namespace app
