#pragma once
// Pictures drawn by gnuplot, a separate program (package gnuplot-nox) that may be missing.

#include <string>

namespace app::report {

enum class Picture { svg, png };

/// Draws a gnuplot script, which sets neither terminal nor output, and returns the bytes of the picture. Throws
/// std::runtime_error, which says what to do, if gnuplot is not installed or cannot draw the script.
std::string draw(const std::string& script, Picture kind);

}  // namespace app::report
