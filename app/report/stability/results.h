#pragma once
// What `report stability` measures, and its table, page and plot.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/reference/reference_trajectory.h"
#include "app/reference/stability_criteria.h"
#include "app/report/page.h"
#include "app/report/worlds.h"
#include "softbody/integrate/integrators.h"
#include "softbody/model/body_model.h"

namespace app::report {

/// A case at one stiffness.
struct StabilityScene {
  softbody::Scene scene{};
  std::vector<Particles> start{};  // per body; empty: as the scene has it
  double first_frame = 0;          // s: one frame of this length comes first; 0: none
};

struct StabilityCase {
  std::string key, name;
  std::function<StabilityScene(double stiffness)> make;  // N/m; of a scene from a file the factor to its own
};

const std::vector<StabilityCase>& stability_cases();

/// Returns the scene with all its stiffnesses and pressures times a factor.
StabilityScene scaled(softbody::Scene scene, double factor);

/// The start of a case, the limits of its motion, and its end by the reference.
struct StabilityStart {
  /// A chain of springs joins any two particles of a body. With some energy, they can be drawn apart by no more than
  /// length + sqrt(2 energy / stiffness). Infinite where springs do not join all particles.
  struct SpringChain {
    double length, stiffness;  // m, N/m: of the chain at rest
  };

  /// One body of the scene as it is when it starts or joins: in its starting shape.
  struct Member {
    std::shared_ptr<const softbody::BodyModel> model;
    SpringChain chain;
    double square_speed;                                            // m^2/s^2
    double radius() const { return model->radius; }                 // m
    double balance() const { return model->start_energy.total(); }  // J: springs and gas
    double mass() const { return model->material[softbody::Material::mass]; }
    double kinetic() const { return 0.5 * mass() * square_speed; }  // J
    double weight() const { return mass() * 9.81 * radius(); }      // J, m g R
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

/// Returns how a state of the body differs from the reference's.
reference::ReferenceDeviation deviation(const softbody::BodyModel& model, const reference::BodyState& state,
                                        const reference::BodyState& reference);

/// Runs and judges a cell. A named integrator takes one step of its own per frame; `auto` chooses its steps. `dt`: s,
/// the length of a frame.
reference::StabilityFigures run_cell(const StabilityStart& start, const softbody::Integrator& integrator, double dt);

/// An extreme case at one stiffness, run by one integrator with frames of one length.
struct StabilityCell {
  std::size_t integrator, dt;  // indices
  reference::StabilityFigures figures{};
  bool passes() const { return reference::failures(figures).empty(); }
};

/// A case, or the user's scene, at one stiffness.
struct StabilityRow : StabilityCase {
  double stiffness = 0;    // as `make` takes it
  StabilityStart start{};  // that all cells share
  std::vector<StabilityCell> cells{};
};

/// The largest step (s) with which a slightly disturbed ball in free flight keeps its energy for 300 steps.
struct StableStep {
  double stiffness = 0;  // N/m
  double found = 0;
  double predicted = 0;  // the integrator's own bound with its safety factor; infinite if it has none
};
inline constexpr double max_step_tried = 0.1;  // s

/// Returns the largest stable step, up to max_step_tried, to within 10 %. `stiffness`: N/m.
StableStep find_stable_step(const softbody::Integrator& integrator, double stiffness);

struct StabilityResults {
  ReportOptions options{};
  double seconds = 0;         // simulated
  std::vector<double> dts{};  // s
  std::vector<const softbody::Integrator*> integrators{};
  std::vector<StabilityRow> rows{};              // those of a case follow each other
  std::vector<std::vector<StableStep>> steps{};  // by integrator; empty if not measured
};

/// Returns stability.csv: a row per cell and a row per point of the map of steps. What has no meaning is empty.
Table stability_table(const StabilityResults& results);
Page stability_page(const StabilityResults& results);

/// Makes the report: what each integrator survives.
void report_stability(const ReportOptions& options);

}  // namespace app::report
