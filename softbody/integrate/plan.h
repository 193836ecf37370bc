#pragma once
// A plan lists the stages of a step that a scene needs, and says why the others are left out. It is made when the scene
// is loaded or changes. A stage that is left out costs no call.

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace softbody {

struct BodyModel;
struct Integrator;
struct Scene;
struct ShapeTraits;

/// A stage of a step. That of a force of the table (forces/table.h) is first_force plus its place there: see stage_of.
enum class Stage {
  arrive,
  hold,
  surface_contact,
  gravity,
  integrate,
  restitution,
  solids,
  solid_features,
  internal_damping,
  rebound_damping,
  rolling_resistance,
  detect,
  sleep,
  first_force
};

/// Returns the stage's key in the plan of `simulate --json`, e.g. "bend-springs".
std::string_view stage_key(Stage stage);

struct LeftOut {
  Stage stage;
  std::string why;
};

struct Plan {
  std::vector<Stage> stages;               // in the order in which a step runs them
  std::vector<LeftOut> left_out;           // in order
  std::vector<const ShapeTraits*> shapes;  // of the solids that are enabled, each once
  bool has(Stage stage) const;
  /// Returns the stages that act as forces although the integrator moves particles to where others have them.
  std::vector<Stage> unprojected(const Integrator& integrator) const;
};

/// What a world has besides its scene's own bodies.
struct AddedBodies {
  std::size_t bodies = 0;  // dropped or thrown in by hand
  bool grabs = false;      // a hand holds a body
  bool holds = false;      // vertices are held by hand, or of such bodies
};

/// `models`: those of the scene's bodies, of its dropper and of the visitors.
Plan make_plan(const Scene& scene, const std::vector<std::shared_ptr<const BodyModel>>& models,
               const AddedBodies& added_bodies = {});

}  // namespace softbody
