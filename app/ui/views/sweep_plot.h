#pragma once
// The plot of error against run time, log-log, drawn with Dear ImGui: a point for each row of a sweep that was timed.

#include "app/compare/sweep.h"
#include "app/ui/widgets/widgets.h"

namespace app::ui {

class SweepPlot {
 public:
  struct Point {
    std::size_t row;                   // of the report
    std::size_t method;                // in collide::method_table()
    std::optional<std::size_t> level;  // in sweep_levels, of methods with levels
    compare::Tradeoff value;           // median time
    ImVec2 at{-1, -1};                 // where it was drawn last
  };
  struct Emphasis {
    std::optional<std::size_t> method;  // the points of all other methods are drawn faintly
    std::optional<std::size_t> row;     // gets a ring: the settings in use
  };

  /// Gathers the report's points of these methods. There are none without true contacts to measure against.
  void set(const compare::SweepReport& report, const compare::MethodSet& methods);
  const std::vector<Point>& points() const { return points_; }

  /// Draws the plot into the rectangle.
  void draw(const Widgets& widgets, const ScreenRect& area, const Emphasis& emphasis);
  /// Returns the nearest drawn point within the pick radius, or nullptr.
  const Point* hit_test(const Widgets& widgets, ImVec2 mouse) const;

  /// Returns how large the mark of a level is, in design pixels: the higher the level, the larger.
  static float mark_radius(std::optional<std::size_t> level);
  /// Draws the ring around the mark of the settings in use.
  static void draw_ring(const Widgets& w, ImVec2 at);

 private:
  struct Axis {
    int first, last;   // exponents of 10 at the ends
    float start, end;  // pixels at the ends
    float at(double value) const;
    float decade(double exponent) const;
  };

  void place_points(const Widgets& widgets, const ScreenRect& area);
  void draw_axes(const Widgets& widgets) const;
  void draw_time_axis(const Widgets& widgets, float top) const;
  void draw_error_axis(const Widgets& widgets) const;
  void draw_front(const Widgets& widgets) const;

  std::vector<Point> points_;
  compare::MethodSet methods_;
  std::vector<std::size_t> front_;  // indices of points_, ascending in time
  Axis time_{}, error_{};
  float bottom_ = 0;  // lower end of the band of points without error, for which a logarithmic axis has no place
};

}  // namespace app::ui
