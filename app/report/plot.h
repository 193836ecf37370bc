#pragma once
// Plots as data, drawn by gnuplot: a separate program (package gnuplot-nox) that may be missing.

#include <string>
#include <vector>

#include "app/compare/method_style.h"

namespace app::report {

struct Point {
  double x, y;
  std::string label{};  // printed beside it
};

/// Points that look alike.
struct Series {
  std::string title;   // empty: not in the key
  std::string colour;  // "#rrggbb"
  std::string style;   // as gnuplot's `with` takes it
  std::vector<Point> points{};
};

/// A picture with two logarithmic axes, unless its settings say otherwise.
struct Plot {
  std::string name;     // of its files, without the ending
  std::string caption;  // one sentence: what the plot shows
  std::string title, x, y;
  std::string settings;  // further gnuplot commands, one a line
  std::vector<Series> series{};

  void add(Series more) {
    if (!more.points.empty()) series.push_back(std::move(more));
  }
};

/// Returns the gnuplot script of a plot, which has a series; it sets no terminal.
std::string script(const Plot& plot);

/// Draws a plot, which has a series, on a terminal of gnuplot, and returns the bytes of the picture. Throws
/// std::runtime_error, which says what to do, if gnuplot is not installed or cannot draw the plot.
std::string draw(const Plot& plot, std::string_view terminal);

/// Returns "#rrggbb".
std::string colour(const collide::Method& method);
/// Returns the number of gnuplot's `pointtype`.
inline int point_type(const collide::Method& method) { return int(compare::style(method).marker); }
/// Returns the colour of series i where these have none of their own. People who see few colours can tell them apart,
/// too (Okabe and Ito 2008).
const char* series_colour(std::size_t i);

}  // namespace app::report
