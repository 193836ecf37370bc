#pragma once
// The view of the hash table: a square for each bucket, coloured by its load. A click shows the bucket's boxes in the
// scene.

#include "app/session/session.h"
#include "app/ui/widgets/bucket_grid.h"
#include "app/ui/widgets/widgets.h"

namespace app::ui {

/// The size and the use of a hash table.
struct TableFigures {
  std::size_t boxes = 0, buckets_used = 0;
  std::uint32_t longest = 0;  // entries of the fullest bucket
};
TableFigures table_figures(const collide::DebugGeometry& geometry);

class HashTableView {
 public:
  /// Draws the view into the current window.
  void draw(Widgets& widgets, const Session& session);

  /// The layout of the squares in the last frame; tests find them by it.
  const BucketGrid& grid() const { return grid_; }
  ImVec2 grid_origin() const { return origin_; }

 private:
  struct Square {
    std::uint32_t load = 0, fullest = 0;  // load and number of the fullest bucket in the square
  };

  void refresh(const Session& session, float width, float height, float min_side);
  void draw_squares(Widgets& widgets, const Session& session, float width, float height);
  void draw_legend(Widgets& widgets) const;
  glm::vec3 colour(std::uint32_t load) const;
  void draw_summary(const Session& session) const;

  BucketGrid grid_;
  ImVec2 origin_{0, 0};
  std::vector<Square> squares_;
  TableFigures figures_;
  std::uint64_t revision_ = 0;  // of the session when squares_ was filled
  std::uint32_t max_load_ = 8;  // end of the colour scale: a power of two, so that it rarely changes
};

}  // namespace app::ui
