#pragma once
// What a world is made of, for the files that implement World. Only they and tests of the solver include this.

#include "softbody/integrate/dynamics.h"
#include "softbody/world/prototype_set.h"
#include "softbody/world/sleep.h"
#include "softbody/world/snapshot.h"
#include "softbody/world/world.h"

namespace softbody {

/// Positions as a detector wants them.
struct Coordinates {
  std::vector<float> x, y, z;
  void add(const glm::vec3& p) {
    x.push_back(p.x);
    y.push_back(p.y);
    z.push_back(p.z);
  }
  collide::Frame frame(const collide::Bodies& bodies) const { return {x, y, z, &bodies}; }
};

struct World::State {
  State(Scene s, const Options& o);

  BodyId add(const BodySource& source, const glm::dvec3& position);
  void arrive();
  void count_vertices();
  void gather();
  void detect();
  void wake_all();
  void set_integrator();
  void wake_near(BodyId body);
  void replan();
  bool implicit_in_reserve(const PrototypeSet& all, const Plan& with) const;
  double substeps(const Prototype& p, float thickness) const;
  void check_room(const Prototype& p, std::size_t number) const;
  void check_stability(const PrototypeSet& all, const Plan& with) const;
  void check_stability(const Prototype& p, bool implicit_in_reserve, bool contacts) const;
  void check_company(const PrototypeSet& all, std::size_t number) const;
  void joined(std::size_t number);  // bodies, by hand
  Dropper dropper() const;          // the scene's, or one over its first body
  void drop(const Dropper& dropper);
  BodyId spawn(BodySource source);
  bool is_clear(const Prototype& p, const glm::dvec3& position) const;
  double clear_height(const Prototype& p, const glm::dvec3& position) const;

  Scene scene;
  Options options;
  collide::Workers workers;
  PrototypeSet prototypes;
  Plan plan;
  Dynamics dynamics;
  Sleep sleep;
  std::vector<char> arrived;  // one a body source of the scene
  Visitors visitors;
  std::vector<AddedBody> added;
  int drops = 0;
  std::array<double, 2> drop_direction{1, 0};  // x and z
  int frame = 0;

  const collide::Method* method;
  std::unique_ptr<collide::Detector> detector;
  collide::Settings settings;
  float shield;  // m, thickness of the response: grows slowly towards the tolerance, so that no slider throws bodies
                 // about

  collide::Bodies bodies;
  std::vector<BodyId> vertex_body;
  Coordinates positions;
  collide::Result result;
  StepReport report;
};

struct Snapshot::Insides {
  Scene scene;  // with all changes
  PrototypeSet prototypes;
  DynamicsState dynamics;
  std::vector<char> arrived;
  Visitors visitors;
  std::vector<AddedBody> added;
  int drops = 0;
  std::array<double, 2> drop_direction{};
  IntegratorChoice integrator;
  const collide::Method* method = nullptr;
  collide::Settings settings;
  float shield = 0;  // m, how thick it has grown
  StepReport report;
};

}  // namespace softbody
