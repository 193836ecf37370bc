#pragma once
// Bodies that move frame by frame, and the contacts that a detector finds between them, to read: World simulates them.
// Who plays recorded ones implements this, too.

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "collide/methods.h"
#include "softbody/scene/scene.h"
#include "softbody/state/body.h"

namespace softbody {

struct BodyModel;
struct Integrator;

/// Report of the last step. Before the first step all numbers but detect_ms are 0.
struct StepReport {
  double detect_ms = 0, solve_ms = 0, total_ms = 0;  // for display only: nothing in the simulation depends on a clock
  double time = 0;                                   // s, since the start, this step included
  /// Time simulated in this step in s: less than frame_time() if a whole frame would exceed the budget of work.
  double seconds = 0;
  int substeps = 0;
  int needed = 0;           // substeps that the stability bound asks for in a whole frame
  double last_substep = 0;  // s, its length
  /// The integrator that moved the bodies; the chosen one if no step was done since the choice.
  const Integrator* integrator = nullptr;
  std::string_view why;  // reason for this integrator; empty unless it was chosen automatically
};

/// The meshes that are simulated: a coarse one where a fine one rides on it. Their contacts move the bodies, and the
/// oracle judges their surfaces. Valid until the next change of the world.
struct SimulatedMeshes {
  collide::Frame positions;
  std::span<const collide::Contact> contacts;  // that the detector found between their vertices
};

class BodiesInMotion {
 public:
  virtual ~BodiesInMotion() = default;

  virtual const Scene& scene() const = 0;                  // with all changes
  virtual const collide::Settings& collision() const = 0;  // the scene's, with the cell size in use
  /// Returns the automatic cell size (§2.2) with these levels. It depends on the shapes of the bodies at the start, not
  /// on the present ones.
  virtual glm::vec3 automatic_cell_size(int levels) const = 0;
  virtual const collide::Method& method() const = 0;
  /// Returns the lower and the upper corner of a box around the bodies in all frames, if that is known.
  virtual std::optional<std::array<glm::vec3, 2>> bounds() const { return std::nullopt; }

  virtual int frame() const = 0;  // from 0
  virtual double frame_time() const = 0;
  virtual const StepReport& last_step() const = 0;
  virtual bool all_at_rest() const = 0;  // no step moves a body: all are asleep, and none is to come or be let go

  // The current state, of the meshes that are shown (BodyModel::shown()).
  virtual const collide::Bodies& bodies() const = 0;
  virtual collide::Frame positions() const = 0;  // in the world, valid until the next change
  virtual SimulatedMeshes simulated() const = 0;
  virtual BodyState body(BodyId body) const = 0;
  virtual const BodyModel& model(BodyId body) const = 0;
  /// Returns the particles of a body that are held, of the mesh that is simulated.
  virtual std::vector<Index> held(BodyId) const { return {}; }
  virtual const collide::Result& detection() const = 0;   // at positions()
  virtual const collide::Detector& detector() const = 0;  // for its debug()
};

}  // namespace softbody
