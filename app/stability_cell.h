#pragma once
// One cell of the matrix: an extreme case at one stiffness, run by one integrator with frames of one length.

#include "app/reference_run.h"
#include "app/stability_cases.h"
#include "app/stability_criteria.h"

namespace app {

/// A case at one stiffness, worked out once for all its cells.
struct StabilityStart {
  softbody::Scene scene;             // its bodies need no balancing any more
  std::vector<Particles> particles;  // that the bodies start with
  double first_frame = 0;            // s
  StabilityLimits limits{};
  double balance = 0;                      // J, springs and gas of all bodies in balance
  std::vector<glm::dvec3> balanced{};      // m, the first body's shape in balance
  std::vector<double> reach{}, softest{};  // m and N/m a body, see extent_reach()
  BodyState truth{};                       // the reference's end, if untold is empty
  std::string untold{};                    // why no reference judges shape, volume and rest
};

/// seconds: simulated. Throws SceneError if the scene cannot be.
StabilityStart prepare(const StabilityScene& scene, double seconds);

/// Fills in truth or untold; steps: at most.
void find_truth(StabilityStart& start, std::uint64_t steps);

/// A named integrator takes one step of its own a frame; `auto` takes those that it likes.
StabilityFigures run_cell(const StabilityStart& start, const softbody::Integrator& integrator, double dt);

/// As many steps a frame as options have them: none for `auto`, which chooses.
std::optional<int> steps_of(const softbody::Integrator& integrator);

}  // namespace app
