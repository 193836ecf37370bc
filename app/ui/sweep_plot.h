#pragma once
// Error against run time, log-log, drawn with Dear ImGui: a point for every row of a sweep that was timed.

#include "app/compare/sweep.h"
#include "app/ui/widgets/widgets.h"

namespace app {

class SweepPlot {
 public:
  struct Point {
    std::size_t row;     // of the report
    std::size_t method;  // in collide::method_table()
    std::size_t level;   // in sweep_levels; 0 for methods without levels
    Tradeoff value;      // median time
    ImVec2 at{-1, -1};   // where it was drawn last
  };
  /// What stands out.
  struct Emphasis {
    std::optional<std::size_t> method;  // the points of all others are pale
    std::optional<std::size_t> row;     // has a ring: the settings in use
  };

  /// Gathers the report's points: none where there are no true contacts to measure against.
  void set(const SweepReport& report);
  const std::vector<Point>& points() const { return points_; }

  /// Draws into the rectangle.
  void draw(const Widgets& widgets, ImVec2 min, ImVec2 max, const Emphasis& emphasis);
  /// The drawn point next to the place, if one is near.
  const Point* near(const Widgets& widgets, ImVec2 place) const;

  /// The mark of a level: disc, square, triangle, triangle upside down.
  static void draw_mark(ImVec2 at, float radius, std::size_t level, ImU32 colour);
  /// Round the mark of the settings in use.
  static void draw_ring(const Widgets& w, ImVec2 at);

 private:
  struct Axis {
    int first, last;   // exponents of 10 at the ends
    float start, end;  // pixels at the ends
    float at(double value) const;
    float decade(int exponent) const;
  };

  void lay_out(const Widgets& widgets, ImVec2 min, ImVec2 max);
  void draw_axes(const Widgets& widgets) const;
  void draw_time_axis(const Widgets& widgets, float top) const;
  void draw_error_axis(const Widgets& widgets) const;
  void draw_front(const Widgets& widgets) const;

  std::vector<Point> points_;
  std::vector<std::size_t> front_;  // indices of points_, ascending in time
  Axis time_{}, error_{};
  float floor_ = 0;  // lower end of the band for points without error, which a logarithmic axis has no place for
};

}  // namespace app
