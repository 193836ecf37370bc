#pragma once

#include <string>
#include <string_view>

#include "collide/methods.h"

namespace app {

/// A picture to be drawn.
struct Plot {
  std::string name;     // of its files, without the ending
  std::string caption;  // one sentence: what is to be seen
  std::string script;   // for draw()
};

// What the scripts of all reports are made of.
inline constexpr const char* plot_style =
    "set logscale xy\n"
    "set grid xtics ytics linecolor '#dddddd' linewidth 1 linetype 1\n"
    "set border linecolor '#666666'\n"
    "set key outside top center horizontal maxcols 3 reverse Left samplen 1.5 width -3\n"
    "set xtics format '%g'\n";
/// As gnuplot reads a string without escapes.
std::string literal(std::string_view text);
std::string colour(const collide::Method& method);

}  // namespace app
