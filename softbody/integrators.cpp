#include "softbody/integrators.h"

#include <array>

#include "softbody/semi_implicit_euler.h"

namespace softbody {
namespace {

constexpr std::array table{
    Integrator{"semi-implicit-euler", "Semi-implicit Euler",
               "Velocity first, then position with the new velocity; substeps from the stability bound.",
               semi_implicit_euler},
};

}  // namespace

std::span<const Integrator> integrators() { return table; }

const Integrator* find_integrator(std::string_view key) {
  for (const Integrator& i : table)
    if (i.key == key) return &i;
  return nullptr;
}

std::string integrator_keys() {
  std::string keys;
  for (const Integrator& i : table) keys.append(keys.empty() ? "" : ", ").append(i.key);
  return keys;
}

}  // namespace softbody
