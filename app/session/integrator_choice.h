#pragma once

#include <optional>
#include <string>

#include "softbody/integrators.h"

namespace app {

/// What moves a world.
struct IntegratorChoice {
  std::string key{softbody::default_integrator};
  std::optional<int> substeps;  // none: as many as stability asks for
  bool operator==(const IntegratorChoice&) const = default;
};

}  // namespace app
