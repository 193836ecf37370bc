#include <cmath>

#include "app/reference/reference_body.h"
#include "app/report/stability/results.h"
#include "softbody/mechanics/bound.h"
#include "softbody/world/measures.h"

namespace app::report {
namespace {

/// A ball of springs and gas. Noise in its start excites every mode.
class DisturbedBall {
 public:
  explicit DisturbedBall(double stiffness)
      : scene_(lone_scene(ball_material(stiffness, 0.1))), balance_(softbody::measure(world_of(scene_)).energy) {
    std::mt19937 random(1);
    start_ = changed_start(scene_, [&](softbody::Particle& p) {
      p.position = p.position * glm::dvec3(1, 0.97, 1) + 0.002 * reference::random_vector(random);  // m
    });
    scene_.materials[0][softbody::Material::start_in_equilibrium] = false;
  }

  bool stable(const softbody::Integrator& integrator, double h) const {
    softbody::World world = make(integrator, h);
    const double start = softbody::measure(world).energy, max_energy = start + 0.05 * (start - balance_);
    for (int i = 0; i < 300; ++i) {
      world.step();
      const softbody::Measures m = softbody::measure(world);
      if (!m.finite || m.energy > max_energy) return false;
    }
    return true;
  }

  double predicted(const softbody::Integrator& integrator) const {
    const softbody::World world = make(integrator, 1);
    const softbody::BodyModel& p = world.model(0);
    const double k_m = softbody::stiffness_per_mass(p, softbody::measure_surface(p, reference::state_of(world, 0).x));
    return integrator.stable_step(k_m, softbody::damping_bound(p) / p.particle_mass);
  }

 private:
  softbody::World make(const softbody::Integrator& integrator, double h) const {
    return start_world(scene_, {.frame_time = h, .integrator = one_step(integrator.key)}, start_);
  }

  softbody::Scene scene_;
  double balance_;
  std::vector<Particles> start_;
};

}  // namespace

StableStep find_stable_step(const softbody::Integrator& integrator, double stiffness) {
  const DisturbedBall ball(stiffness);
  StableStep s{.stiffness = stiffness, .found = max_step_tried, .predicted = ball.predicted(integrator)};
  if (ball.stable(integrator, max_step_tried)) return s;
  double good = 1e-8, bad = max_step_tried;
  while (bad / good > 1.1) {
    const double middle = std::sqrt(good * bad);
    (ball.stable(integrator, middle) ? good : bad) = middle;
  }
  s.found = good;
  return s;
}

}  // namespace app::report
