#include "tests/bench/step/pile.h"

#include <array>

#include "engine/resources.h"
#include "softbody/forces/gas.h"
#include "softbody/forces/springs.h"

namespace bench {
namespace {

constexpr double stiffness = 1e4;  // N/m, of structural springs; a quarter of it of bend springs

// Bullet's gas knows no air around it, and kicks particles by its whole pressure each step: only the mildest is one
// that it bears at 60 Hz.
constexpr std::array<Gas, 3> table{{
    {"mild", "10 Pa", 10, 0},
    {"mild-x100", "1,000 Pa", 1000, 0},
    {"scene", "scene D's: 113,000 Pa in air", 113'000, 101'325},
}};

}  // namespace

std::span<const Gas> gases() { return table; }

softbody::Scene stiff_pile(const Gas& gas) {
  softbody::Scene scene = softbody::find_scene("D", engine::find_folder("assets") / "scenes");
  scene.dropper.reset();
  scene.sleep.speed = 0;  // Bullet's soft bodies never sleep
  for (softbody::Material& material : scene.materials) {
    material[softbody::StructuralSprings::stiffness] = stiffness;
    material[softbody::BendSprings::stiffness] = stiffness / 4;
    material[softbody::GasPressure::inside] = gas.pressure;
    material[softbody::GasPressure::outside] = gas.ambient;
  }
  return scene;
}

}  // namespace bench
