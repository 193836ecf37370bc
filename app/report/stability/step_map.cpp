#include <cmath>

#include "app/reference/reference_body.h"
#include "app/report/stability/results.h"
#include "softbody/mechanics/bound.h"
#include "softbody/world/measures.h"

namespace app::report {
StableStep find_stable_step(const softbody::Integrator& integrator, double stiffness) {
  // A ball of springs and gas. Noise in its start excites every mode.
  softbody::Scene scene = lone_scene(ball_material(stiffness, 0.1));
  const double balance = softbody::measure(world_of(scene)).energy;
  std::mt19937 random(1);
  const std::vector<Particles> start = changed_start(scene, [&](softbody::Particle& p) {
    p.position = p.position * glm::dvec3(1, 0.97, 1) + 0.002 * reference::random_vector(random);  // m
  });
  scene.materials[0][softbody::Material::start_in_equilibrium] = false;
  const auto make = [&](double h) {
    return start_world(scene, {.frame_time = h, .integrator = one_step(integrator.key)}, start);
  };
  const auto stable = [&](double h) {
    softbody::World world = make(h);
    const double energy = softbody::measure(world).energy, max_energy = energy + 0.05 * (energy - balance);
    for (int i = 0; i < 300; ++i) {
      world.step();
      const softbody::Measures m = softbody::measure(world);
      if (!m.finite || m.energy > max_energy) return false;
    }
    return true;
  };
  const softbody::World world = make(1);
  const softbody::BodyModel& model = world.model(0);
  const double k_m =
      softbody::stiffness_per_mass(model, softbody::measure_surface(model, reference::state_of(world, 0).x));
  StableStep s{.stiffness = stiffness,
               .found = max_step_tried,
               .predicted = integrator.stable_step(k_m, softbody::damping_bound(model) / model.particle_mass)};
  if (stable(max_step_tried)) return s;
  double good = 1e-8, bad = max_step_tried;
  while (bad / good > 1.1) {
    const double middle = std::sqrt(good * bad);
    (stable(middle) ? good : bad) = middle;
  }
  s.found = good;
  return s;
}

}  // namespace app::report
