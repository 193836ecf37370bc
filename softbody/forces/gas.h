#pragma once
// Gas in closed bodies.

#include <array>

#include "softbody/model/key.h"

namespace softbody {

struct GasPressure {
  static constexpr auto inside = Key("gas_pressure", "Pa", 0, {0, 1e9},
                                     "Absolute pressure of the gas in a closed body at the volume V0 of the mesh. It "
                                     "grows as the volume V shrinks: gas_pressure V0 / V.",
                                     {"Gas", "%.1f kPa", 50, 200, false, 1e3});
  static constexpr auto outside =
      Key("ambient_pressure", "Pa", 0, {0, 1e9}, "Absolute pressure outside closed bodies.");
  static constexpr std::array keys{&inside, &outside};
};

}  // namespace softbody
