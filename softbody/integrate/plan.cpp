#include "softbody/integrate/plan.h"

#include <algorithm>
#include <array>

#include "softbody/contact/keys.h"
#include "softbody/forces/model_forces.h"
#include "softbody/integrate/force_stage.h"
#include "softbody/integrate/integrators.h"
#include "softbody/integrate/resistance.h"
#include "softbody/scene/scene.h"

namespace softbody {
namespace {

struct Facts {
  const Scene& scene;
  const std::vector<std::shared_ptr<const BodyModel>>& models;
  const AddedBodies& added_bodies;
  std::size_t bodies() const {  // a dropper can always add another
    return scene.dropper ? 2 : scene.bodies.size() + added_bodies.bodies;
  }
  bool any_source(bool (*test)(const BodySource&)) const { return std::ranges::any_of(scene.bodies, test); }
  template <class Test>
  bool any(Test test) const {
    return std::any_of(models.begin(), models.end(), [&](const auto& model) { return test(*model); });
  }
  bool any_solid(bool (*test)(const Solid&) = [](const Solid&) { return true; }) const {
    return std::ranges::any_of(scene.solids, [&](const Solid& s) { return s.enabled && test(s); });
  }
};

using Why = const char* (*)(const Facts&);  // nullptr: the stage is needed

const char* needed(const Facts&) { return nullptr; }

const char* arrivals(const Facts& f) {
  const bool late = f.any_source([](const BodySource& b) {
    return b.appear > 0 || b.release > 0 ||
           std::ranges::any_of(b.holds, [](const Hold& h) { return h.from > 0 || h.until > 0; });
  });
  return late || f.added_bodies.holds ? nullptr : "all bodies are there and free from the start";
}

const char* holds(const Facts& f) {
  const bool any = f.added_bodies.holds || f.any_source([](const BodySource& b) { return !b.holds.empty(); });
  return any ? nullptr : "no vertex is held";
}

const char* contacts(const Facts& f) {
  return f.bodies() > 1 || f.scene.collision.self_collision ? nullptr : "one body, and self-collision is off";
}

const char* surface_contacts(const Facts& f) {
  return f.scene.contact_surface == ContactSurface::surfaces ? contacts(f) : "the vertices keep the bodies apart";
}

template <class F>
const char* force(const Facts& f) {
  const bool vertices = f.scene.contact_surface == ContactSurface::vertices;
  if constexpr (requires(ForceFacts facts) { F::why_not(facts); })
    return F::why_not({f.models, vertices ? contacts(f) : "the surfaces keep the bodies apart", f.added_bodies.grabs});
  else
    return f.any([](const BodyModel& model) { return data<F>(model) != nullptr; }) ? nullptr : F::absent;
}

const char* gravity(const Facts& f) { return f.scene.gravity != glm::dvec3(0.0) ? nullptr : "the scene has none"; }

const char* solids(const Facts& f) { return f.any_solid() ? nullptr : "the scene has no solid"; }

const char* restitution(const Facts& f) {
  const bool any = f.any_solid([](const Solid& s) { return s.restitution > 0; }) ||
                   f.any([](const BodyModel& model) { return model.material[contact::restitution] > 0; });
  return any ? nullptr : "no solid and no material has restitution";
}

const char* damping(const Facts& f) {
  return f.any([](const BodyModel& model) { return internal_damping(model) > 0; }) ? nullptr
                                                                                   : "no material has internal damping";
}

const char* rebound(const Facts& f) {
  if (!f.any_solid()) return "no solid to rebound from";
  return f.any([](const BodyModel& model) { return model.material[contact::rebound_speed] > 0; })
             ? nullptr
             : "no material has a rebound speed";
}

const char* solid_features(const Facts& f) {
  if (f.scene.contact_surface == ContactSurface::vertices) return "the vertices keep off the solids";
  return f.any_solid([](const Solid& s) { return !s.traits().half_space; }) ? nullptr : "no solid is round or sharp";
}

const char* rolling(const Facts& f) {
  if (!f.any_solid()) return "no solid to roll on";
  return f.any([](const BodyModel& model) { return model.rolls && model.material[contact::rolling_resistance] > 0; })
             ? nullptr
             : "no closed body with rolling resistance";
}

const char* sleep(const Facts& f) { return f.scene.sleep.speed > 0 ? nullptr : "the scene's sleep speed is 0"; }

struct Row {
  Stage stage;
  std::string_view key;
  Why why_not;
  bool unprojected = false;
};

constexpr std::array before_forces{
    Row{Stage::arrive, "arrive", arrivals},
    Row{Stage::hold, "hold", holds},
    Row{Stage::surface_contact, "surface-contact", surface_contacts},
};

constexpr std::array after_forces{
    Row{Stage::gravity, "gravity", gravity},
    Row{Stage::integrate, "integrate", needed},
    Row{Stage::restitution, "restitution", restitution},
    Row{Stage::solids, "solids", solids},
    Row{Stage::solid_features, "solid-features", solid_features},
    Row{Stage::internal_damping, "internal-damping", damping},
    Row{Stage::rebound_damping, "rebound-damping", rebound},
    Row{Stage::rolling_resistance, "rolling-resistance", rolling},
    Row{Stage::detect, "detect", contacts},
    Row{Stage::sleep, "sleep", sleep},
};

/// In the order in which a step runs them.
constexpr auto all_stages = [] {
  std::array<Row, before_forces.size() + force_count + after_forces.size()> rows{};
  auto next = std::ranges::copy(before_forces, rows.begin()).out;
  for_each_force(Forces{}, [&]<class F>(Name<F>) { *next++ = {stage_of<F>, F::key, force<F>, is_unprojected<F>()}; });
  std::ranges::copy(after_forces, next);
  return rows;
}();

const Row& row_of(Stage stage) { return *std::ranges::find(all_stages, stage, &Row::stage); }

}  // namespace

std::string_view stage_key(Stage stage) { return row_of(stage).key; }

bool Plan::has(Stage stage) const { return std::find(stages.begin(), stages.end(), stage) != stages.end(); }

std::vector<Stage> Plan::unprojected(const Integrator& integrator) const {
  std::vector<Stage> list;
  if (!integrator.projects) return list;
  std::ranges::copy_if(stages, std::back_inserter(list), [](Stage s) { return row_of(s).unprojected; });
  return list;
}

Plan make_plan(const Scene& scene, const std::vector<std::shared_ptr<const BodyModel>>& models,
               const AddedBodies& added_bodies) {
  Plan plan;
  const Facts facts{scene, models, added_bodies};
  for (const Row& row : all_stages) {
    if (const char* why = row.why_not(facts))
      plan.left_out.push_back({row.stage, why});
    else
      plan.stages.push_back(row.stage);
  }
  for (const Solid& s : scene.solids)
    if (s.enabled && std::ranges::count(plan.shapes, &s.traits()) == 0) plan.shapes.push_back(&s.traits());
  return plan;
}

}  // namespace softbody
