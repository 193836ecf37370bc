#pragma once
// A world simulates a scene. One step() is one frame: bodies arrive, respond to the contacts found last, and move; then
// contacts are detected at the new positions, and bodies at rest fall asleep. Everything that can be read afterwards
// (positions, contacts, boxes) belongs to the same instant.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "collide/methods.h"
#include "softbody/contact/contacts.h"
#include "softbody/forces/grab.h"
#include "softbody/integrate/integrators.h"
#include "softbody/integrate/plan.h"
#include "softbody/integrate/work.h"
#include "softbody/world/bodies_in_motion.h"

namespace softbody {

struct Snapshot;
class State;

/// A body that is not from the scene.
struct AddedBody {
  BodyId body;
  BodySource source;  // with which a scene would add it in the same frame at the same place
};

class World : public BodiesInMotion {
 public:
  struct Options {
    int threads = 1;
    double frame_time = 1.0 / 60.0;  // s
    IntegratorChoice integrator{};
    double least_share = collide::Workers::least_share;  // of work, which each thread is to have: ns
    WorkBudget budget{};
    MaxCandidates max_candidates{};
    /// Throws SceneError if it would take too long to find the contacts of a frame in this way.
    std::function<void(const BodiesInMotion&, const collide::Method&, const collide::Settings&)> check_work{};
  };

  /// Throws SceneError if a body has too many particles for implicit steps, and these are chosen.
  World(Scene scene, const Options& options);

  /// Simulates one frame. Calls `after_substep` after each substep; it may read positions(), which are up to date, but
  /// nothing else, and must not change the world.
  void step(const std::function<void()>& after_substep = {});
  /// Returns everything that determines how the world continues.
  Snapshot snapshot() const;
  /// Puts the world into the state of the snapshot, settings included, and detects. It then continues, to the bit, as
  /// the world of the snapshot did, which may be another world. Its threads and frame time do not change.
  void restore(const Snapshot& snapshot);

  // Changes between frames. Each of them detects again if contacts may have changed.
  /// Places the body's particles, wakes all bodies and detects. `particles`: finite, one for each vertex of the mesh
  /// that is simulated.
  void set_particles(BodyId body, std::span<const Particle> particles);
  /// Adds `count` bodies at the scene's dropper, or above its first body if it has none. Each appears above everything
  /// that is in the way; several are spread more widely than one. Returns the last of them. Throws SceneError, and then
  /// adds none, if the world would have more than max_particles.
  BodyId drop(int count = 1);
  /// Adds a body now, and not held; the frames of the source are ignored. Throws SceneError as the constructor and
  /// drop() do.
  BodyId add(const BodySource& source);
  /// Throws a body of the kind that drop() adds. It appears at the first clear place of the flight that begins at
  /// `from` (m) with `velocity` (m/s, not 0). Returns nothing if there is no clear place.
  std::optional<BodyId> throw_body(const glm::dvec3& from, const glm::dvec3& velocity);
  /// Returns the bodies of drop(), add() and throw_body() that were not removed, in the order in which they came.
  const std::vector<AddedBody>& added() const;
  /// Returns the scene's bodies and the added ones, with what switch_hold() did. A world of a scene with these bodies
  /// moves the same way, to the bit, if nothing else was changed by hand and if adding bodies did not change the plan.
  std::vector<BodySource> body_sources() const;
  /// Removes a body and wakes its neighbours. The ids of later bodies, and their vertices, move up.
  void remove(BodyId body);
  /// Lets the hand grab a body, or changes its point or target; there is one hand. nullopt: the hand lets go. A grabbed
  /// body wakes up, stays awake, and is no longer held in place.
  void grab(const std::optional<Grab>& grab);
  const std::optional<Grab>& grabbed() const;
  /// Lets go of the held particles near a particle, up to a fifth of the body's radius away at rest; if there are none,
  /// holds it where it is. Returns true if it is held now.
  bool switch_hold(BodyId body, Index particle);
  /// Holds of each body what `other` holds, a world of the same bodies.
  void copy_holds(const World& other);

  /// Makes `wanted` the scene, all but its bodies and dropper: those of the world stay. Materials are told apart by
  /// their place in the list; those beyond the end of the wanted list stay, further ones are for later bodies. Bodies
  /// keep their positions, and new bodies start in the same shape as before the change. Wakes all bodies if anything
  /// that acts on them is another. Changes nothing if it throws: SceneError for what problem() or Options::check_work
  /// refuses, or what a detector throws.
  void apply(const Scene& wanted);
  /// Throws SceneError as the constructor does. The choice's key must be known.
  void set_integrator(const IntegratorChoice& choice);

  const Scene& scene() const override;
  const collide::Settings& collision() const override;
  glm::vec3 automatic_cell_size(int levels) const override;
  const collide::Method& method() const override;
  const IntegratorChoice& integrator_choice() const;
  const Plan& plan() const;
  int frame() const override;  // steps done
  double frame_time() const override;
  const StepReport& last_step() const override;
  bool all_at_rest() const override;

  const collide::Bodies& bodies() const override;
  collide::Frame positions() const override;
  SimulatedMeshes simulated() const override;
  BodyState body(BodyId body) const override;
  const BodyModel& model(BodyId body) const override;
  std::vector<Index> held(BodyId body) const override;
  const collide::Result& detection() const override;
  const collide::Detector& detector() const override;
  Particle particle(BodyId body, Index vertex) const;
  const State& state() const;        // of all particles
  std::uint64_t state_hash() const;  // over the bits of positions and velocities, in the order of bodies
  std::vector<SurfaceContactPoint> surface_contacts() const;  // if all bodies sleep: of the last substep before

 private:
  friend struct WorldTestAccess;  // for tests of the solver
  struct Parts;
  struct DeleteParts {
    void operator()(Parts* parts) const;
  };
  std::unique_ptr<Parts, DeleteParts> parts_;
};

}  // namespace softbody
