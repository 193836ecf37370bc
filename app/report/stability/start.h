#pragma once
// What all cells of one case at one stiffness share: where it starts, what it may do from there, where it must end.

#include "app/reference/reference_run.h"
#include "app/reference/stability_criteria.h"
#include "app/report/stability/cases.h"

namespace app {

struct StabilityStart {
  /// Any two particles of a body are joined by a chain of springs: they can be drawn apart by no more than
  /// length + sqrt(2 energy / stiffness). Infinite where springs do not join them all.
  struct Leash {
    double length, stiffness;  // m, N/m: of the chain at rest
  };

  /// One body of the scene, whether it begins or joins later, as it is then.
  struct Member {
    Leash leash;
    double radius, mass, particle_mass;  // m, kg, kg
    double balance, kinetic, height;     // J: springs and gas; of motion; of gravity, 0 at the origin
    double energy() const { return balance + kinetic + height; }
    double weight() const { return mass * 9.81 * radius; }  // J, m g R
  };

  softbody::Scene scene;             // its bodies in the order in which they join
  std::vector<Particles> particles;  // that the bodies start with
  double first_frame = 0;            // s, see StabilityScene
  StabilityLimits limits{};
  double above_balance = 0;            // J, E0 - E_eq of those that begin
  std::vector<Member> members{};       // the bodies of the scene
  std::vector<glm::dvec3> balanced{};  // m, the first body's shape in balance
  BodyState reference{};               // the reference's end, if not_judged is empty
  std::string not_judged{};            // why no reference judges shape, volume and rest
};

/// seconds: simulated. Throws SceneError if the scene cannot be.
StabilityStart prepare(const StabilityScene& scene, double seconds);

/// Fills in reference or not_judged; steps: of the reference, at most.
void find_reference(StabilityStart& start, std::uint64_t steps);

std::vector<Particles> all_particles(const softbody::World& world);
/// J, of gravity on one body, 0 at the origin.
double height_energy(const softbody::World& world, const Particles& particles, softbody::BodyId body);

}  // namespace app
