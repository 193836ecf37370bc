#pragma once

#include <array>
#include <cstddef>

namespace app {

/// Of the table's integrator i in plots: told apart by people who see few colours, too (Okabe and Ito 2008).
inline const char* integrator_colour(std::size_t i) {
  static constexpr std::array colours{"#000000", "#e69f00", "#0072b2", "#009e73",
                                      "#cc79a7", "#d55e00", "#56b4e9", "#888888"};
  return colours[i % colours.size()];
}

}  // namespace app
