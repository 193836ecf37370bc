#pragma once
// What all move: scene D with stiff springs.

#include <span>
#include <string_view>

#include "softbody/scene/scene.h"

namespace bench {

struct Gas {
  std::string_view key;
  std::string_view what;  // one phrase
  double pressure;        // Pa, of the gas at the mesh's own volume
  double ambient;         // Pa
};

std::span<const Gas> gases();

softbody::Scene stiff_pile(const Gas& gas);

}  // namespace bench
