#pragma once
// Parts of a world. Only the files that implement World and tests of the solver include this.

#include <map>

#include "softbody/integrate/solver.h"
#include "softbody/mesh/points.h"
#include "softbody/world/body_model_set.h"
#include "softbody/world/sleep.h"
#include "softbody/world/snapshot.h"
#include "softbody/world/world.h"

namespace softbody {

/// Positions that the solver writes, and which are an input of detectors.
struct Coordinates : Points {
  Field<float> resized(std::size_t size) {
    x.resize(size), y.resize(size), z.resize(size);
    return {x.data(), y.data(), z.data()};
  }
  collide::Frame input(const collide::Bodies& bodies) const { return {x, y, z, &bodies}; }
};

struct Detection {
  std::unique_ptr<collide::Detector> detector;
  collide::Result result;
};

/// A mesh of each body, where it is now, and the contacts between them.
struct DetectedMeshes : Detection {
  collide::Bodies bodies;
  std::vector<BodyId> vertex_body;
  Coordinates positions;

  void add(const std::shared_ptr<const collide::Shape>& shape) {
    vertex_body.resize(vertex_body.size() + shape->vertex_count(), bodies.count());
    bodies.add(shape);
  }
  collide::Frame input() const { return positions.input(bodies); }
};

/// What decides how a world goes on, beside its solver's state.
struct WorldValues {
  WorldValues(Scene s, const IntegratorChoice& integrator);

  Scene scene;  // with all changes
  BodyModelSet models;
  std::vector<char> arrived;  // for each body source of the scene
  AddedBodies added_bodies;
  std::vector<AddedBody> added;
  std::map<int, std::vector<Hold>> changed_holds;  // by hand, of the scene's body of this index
  int drops = 0;
  std::array<double, 2> drop_direction{1, 0};  // x and z
  int frame = 0;
  IntegratorChoice choice;
  StepReport report;
};

struct World::Parts : WorldValues {
  Parts(Scene s, const Options& o);

  /// Makes a change by the user, and books the energy that it gives to the bodies.
  void book_change(const auto& change) {
    const double before = energy();
    change();
    solver.state().ledger.book(WorkBy::user, energy() - before);
  }
  double energy() const;  // J, of all bodies
  BodyId add(const BodySource& source, const glm::dvec3& position);
  std::vector<HeldVertices> held_vertices(const BodySource& source) const;
  std::vector<Hold>& source_holds(BodyId body);
  void switch_holds(BodyId body);
  void hold(BodyId body, std::vector<HeldVertices> holds);
  void arrive();
  void count_vertices();
  void update_positions();
  void place_fine_meshes();
  const collide::Method& method() const { return *collide::find_method(scene.method); }
  const DetectedMeshes& shown() const { return fine ? *fine : particles; }
  void for_each_meshes(const auto& change) {
    change(particles);
    if (fine) change(*fine);
  }
  void detect();
  void wake_all();
  void detect_anew(const World& world, const Scene& next, const Plan& next_plan);
  collide::Settings settings_of(const Scene& of) const;
  void set_integrator();
  void wake_near(BodyId body);
  void update_plan();
  void check_capacity(const BodyModel& model, std::size_t number) const;
  void check_sizes(const BodyModelSet& all, const IntegratorChoice& wanted) const;
  void bodies_added(std::size_t number);  // by hand
  Dropper dropper() const;                // the scene's, or one over its first body
  void drop(const Dropper& dropper);
  BodyId spawn(BodySource source);
  bool is_clear(const BodyModel& model, const BodySource& source) const;
  double clear_height(const BodyModel& model, const glm::dvec3& position) const;

  decltype(Options::check_work) check_work;
  double frame_time;                                // s
  collide::Settings settings = settings_of(scene);  // in use
  collide::Workers workers;
  Plan plan;
  Solver solver;

  DetectedMeshes particles;            // the meshes that are simulated; their contacts act
  std::optional<DetectedMeshes> fine;  // the meshes that are shown, if they are others
  std::vector<Embedding::Scratch> placing{std::size_t(workers.threads())};  // of each thread
};

struct Snapshot::Values {
  WorldValues world;
  SolverState solver;
};

}  // namespace softbody
