#pragma once
// The cells of the report, each an extreme case at one stiffness, run by one integrator with frames of one length; and
// what all cells of one case at one stiffness share.

#include "app/reference/reference_trajectory.h"
#include "app/reference/stability_criteria.h"
#include "app/report/stability/cases.h"

namespace app::report {

/// The start of a case, the limits of its motion, and its end by the reference.
struct StabilityStart {
  /// A chain of springs joins any two particles of a body. With some energy, they can be drawn apart by no more than
  /// length + sqrt(2 energy / stiffness). Infinite where springs do not join all particles.
  struct SpringChain {
    double length, stiffness;  // m, N/m: of the chain at rest
  };

  /// One body of the scene as it is when it starts or joins.
  struct Member {
    SpringChain chain;
    double radius, mass, particle_mass;                     // m, kg, kg
    double balance, kinetic;                                // J: springs and gas; of motion
    double weight() const { return mass * 9.81 * radius; }  // J, m g R
  };

  softbody::Scene scene;             // its bodies in the order in which they join
  std::vector<Particles> particles;  // that the bodies start with
  double first_frame = 0;            // s, see StabilityScene
  reference::StabilityLimits limits{};
  double above_balance = 0;                 // J, E0 - E_eq of the bodies that are there at the start
  std::vector<Member> members{};            // the bodies of the scene
  std::vector<glm::dvec3> balance_shape{};  // m, the first body's shape in balance
  reference::BodyState reference{};         // the reference's end, if not_judged is empty
  std::string not_judged{};                 // why no reference judges shape, volume and rest
};

/// Returns the start of runs of `seconds` of simulated time. Throws SceneError if the scene cannot be simulated.
StabilityStart prepare(const StabilityScene& scene, double seconds);

/// Fills in `reference` or `not_judged`. The reference takes at most `steps` steps.
void find_reference(StabilityStart& start, std::uint64_t steps);

/// Returns the particles of each body.
std::vector<Particles> all_particles(const softbody::World& world);
/// Returns the energy (J) of gravity on one body whose particles are at x, 0 at the origin.
double height_energy(const softbody::World& world, const std::vector<glm::dvec3>& x, softbody::BodyId body);

/// Returns how a state of the body differs from the reference's.
reference::ReferenceDeviation deviation(const softbody::BodyModel& model, const reference::BodyState& state,
                                        const reference::BodyState& reference);

/// Runs and judges a cell. A named integrator takes one step of its own per frame; `auto` chooses its steps. `dt`: s,
/// the length of a frame.
reference::StabilityFigures run_cell(const StabilityStart& start, const softbody::Integrator& integrator, double dt);

}  // namespace app::report
