#pragma once
// The world: a scene in motion. One step() is one frame: arrivals, response to the contacts found last, motion,
// detection on the new positions, sleep. What can be read afterwards (positions, contacts, boxes) all belongs to the
// same instant.

#include "softbody/dynamics.h"
#include "softbody/integrators.h"

namespace softbody {

/// Milliseconds of one step. For display only: nothing in the simulation depends on a clock.
struct Profile {
  double detect_ms = 0, solve_ms = 0, total_ms = 0;
  int substeps = 0;
  double seconds = 0;  // simulated: less than a frame's where that would have taken more substeps than there may be
};

struct SolidContact {
  Index vertex;      // over the whole world
  glm::vec3 normal;  // out of the solid
};

/// A body that no scene brought.
struct AddedBody {
  BodyId body;
  BodySource source;  // as a scene would bring it, in the same frame to the same place
};

struct Snapshot;

class World {
 public:
  struct Options {
    int threads = 1;
    double frame_time = 1.0 / 60.0;  // s
    std::string integrator{default_integrator};
    /// Exactly so many of the integrator's a frame, whatever becomes of it; none: as many as stability asks for.
    std::optional<int> substeps{};
    Isa isa = best_isa();
    /// Particles of moving bodies; threads share no fewer: one has moved them before the others have woken up.
    std::size_t least_shared = 20'000;
    MaxWork max_work{};
  };
  static constexpr int max_substeps = Dynamics::max_substeps;  // a frame

  /// Throws SceneError if a material is too stiff for its mass, or the tolerance too wide: if a frame would take more
  /// than max_substeps.
  World(Scene scene, const Options& options);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// after_substep: looks at positions(), which are those of then; nothing else is up to date, and nothing may be
  /// changed.
  void step(const std::function<void()>& after_substep = {});
  /// All that decides how the world goes on; see snapshot.h.
  Snapshot snapshot() const;
  /// The world as it was, settings included, and detects. It goes on from there to the bit, whatever happened since and
  /// also in another world than the one that the snapshot was taken of; its threads, frame time and isa stay.
  void restore(const Snapshot& snapshot);
  /// Detects again on the current positions without moving anything.
  void redetect();
  /// Puts a body's particles where they are told, one a vertex and finite, wakes all and detects.
  void set_particles(BodyId body, std::span<const Particle> particles);

  // Changes by hand, between frames. Each detects again where contacts may be others.
  /// Adds bodies at the scene's dropper, or else above its first body, each above whatever is in the way; several are
  /// spread more widely than one. Returns the last. Throws SceneError, and adds none, as construction does.
  BodyId drop(int count = 1);
  /// Adds a body of any mesh, now and free, whatever the source says of frames. Throws SceneError as construction does.
  BodyId add(const BodySource& source);
  /// For bodies to come; its index in the scene's materials. Its name must be new.
  int add_material(const Material& material);
  /// Throws a body of the kind that drop() adds, from the first clear place a little way along `velocity` (m/s, not 0).
  /// Nothing if there is none.
  std::optional<BodyId> throw_body(const glm::dvec3& from, const glm::dvec3& velocity);
  /// Those of drop(), add() and throw_body() that are still there, in the order in which they came.
  const std::vector<AddedBody>& added() const;
  /// The scene's bodies and the added ones. A world of a scene with these goes the same way to the bit, if hands did
  /// nothing else and the plan of a lone body did not need to change for company.
  std::vector<BodySource> sources() const;
  /// Takes a body out. Those after it move up by one id, and their vertices with them; its neighbours wake.
  void remove(BodyId body);
  /// A hand takes a body, which wakes, stays awake, and is no longer held in place. There is one hand.
  void grab(const Grab& grab);
  void pull_to(const glm::dvec3& target);  // m; of the body that is grabbed, if any
  void release();
  const std::optional<Grab>& grabbed() const;
  // Everything wakes. The scene changes with them, and the plan follows; values must be such as a scene file allows.
  void set_gravity(const glm::dvec3& gravity);  // m/s^2
  /// index: into the scene's materials. Bodies go on from where they are, and new ones start in the shape that they
  /// would have started in before. Throws SceneError, and changes nothing, if it is too stiff.
  void set_material(std::size_t index, const Material& material);
  void set_solids(const Scene& scene);  // takes over that scene's solids, the ground included

  const Scene& scene() const;
  int frame() const;    // steps done
  double time() const;  // s, that they have simulated
  double frame_time() const;
  const Plan& plan() const;

  // Collision settings. Setters detect again and wake all bodies; problem(settings) must be empty, the key known.
  const collide::Settings& collision() const;  // cell_size as in use: the default one worked out
  bool uses_default_cell_size() const;
  const collide::Method& method() const;
  void set_method(std::string_view key);
  // How bodies move; wakes all. The key must be known; substeps as in Options. Throws SceneError as the constructor.
  void set_integrator(std::string_view key, std::optional<int> substeps);
  const Integrator& integrator() const;
  std::optional<int> substeps() const;
  void set_contact_surface(ContactSurface surface);  // throws SceneError as the constructor
  void set_collision(const collide::Settings& settings, bool default_cell_size);

  // The current state.
  const collide::Bodies& bodies() const;
  collide::Frame positions() const;  // world floats, valid until the next change
  const Prototype& prototype(BodyId body) const;
  const Body& body(BodyId body) const;
  const collide::Result& detection() const;     // on positions()
  const collide::Detector& detector() const;    // for its debug()
  std::span<const BodyId> vertex_body() const;  // the body of each vertex
  std::vector<SolidContact> solid_contacts() const;
  // What pairs of the shield between bodies that move hold, ascending by contact: those of detection(), which the
  // coming step goes by, and those that the last step went by.
  std::vector<PairEnergy> shield_energies() const;
  std::vector<PairEnergy> last_shield_energies() const;
  bool all_at_rest() const;          // every body asleep, none still to come
  const Profile& profile() const;    // of the last step
  std::uint64_t state_hash() const;  // over the bits of positions and velocities, in body order
  const Dynamics& dynamics() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace softbody
