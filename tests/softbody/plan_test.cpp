// The plan: which stages a scene needs, why others are left out, and that a stage left out changes no bit.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <glm/geometric.hpp>

#include "softbody/integrate/force_stage.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

World world_of(const std::string& toml) {
  const TemporaryFolder folder;
  return World(load_scene(folder.write("plan.toml", toml)), {});
}

std::string why(const Plan& plan, Stage stage) {
  for (const LeftOut& l : plan.left_out)
    if (l.stage == stage) return l.why;
  return {};
}

TEST(Plan, EachStageIsRunOrLeftOutWithAReason) {
  for (const char* toml : {"[[body]]\n", "[ground]\n[[body]]\n[[body]]\nrelease = 3\n"}) {
    const World world = world_of(toml);
    const Plan& plan = world.plan();
    constexpr int count = int(Stage::first_force) + int(force_count);
    EXPECT_EQ(plan.stages.size() + plan.left_out.size(), std::size_t(count));
    for (int s = 0; s < count; ++s) {
      const auto stage = Stage(s);
      EXPECT_FALSE(stage_key(stage).empty());
      EXPECT_NE(plan.has(stage), !why(plan, stage).empty()) << stage_key(stage);
    }
    // A step runs the forces in the order of their table, just before gravity.
    const auto gravity = std::ranges::find(plan.stages, Stage::gravity);
    const auto first = std::ranges::find_if(plan.stages, [](Stage s) { return s >= Stage::first_force; });
    EXPECT_TRUE(std::is_sorted(plan.stages.begin(), first) && std::is_sorted(gravity, plan.stages.end()));
    EXPECT_TRUE(std::is_sorted(first, gravity));
    EXPECT_TRUE(std::all_of(first, gravity, [](Stage s) { return s >= Stage::first_force; }));
  }
}

TEST(Plan, SaysWhyAStageIsLeftOut) {
  const struct {
    const char* toml;
    std::vector<std::pair<Stage, const char*>> out;
    std::vector<Stage> in;
  } rows[]{
      {"[collision]\nself_collision = false\n[ground]\n[[material]]\nshear = {stiffness = 10}\ngas_pressure = 2\n"
       "rolling_resistance = 1\n[[body]]\nmesh = {kind = \"grid\", columns = 3, rows = 3}\n",
       {{stage_of<GasPressure>, "no closed body with gas"},
        {Stage::rolling_resistance, "no closed body with rolling resistance"},
        {Stage::detect, "one body, and self-collision is off"},
        {stage_of<PenaltyContact>, "one body, and self-collision is off"}},
       {stage_of<ShearSprings>, Stage::solids, Stage::gravity}},
      {"gravity = [0, 0, 0]\n[sleep]\nspeed = 0\n[[material]]\nrebound_speed = 2\n[[body]]\n",
       {{Stage::gravity, "the scene has none"},
        {Stage::solids, "the scene has no solid"},
        {Stage::restitution, "no solid and no material has restitution"},
        {Stage::rolling_resistance, "no solid to roll on"},
        {Stage::rebound_damping, "no solid to rebound from"},
        {Stage::internal_damping, "no material has internal damping"},
        {stage_of<ShearSprings>, "no body has such springs"},
        {Stage::sleep, "the scene's sleep speed is 0"},
        {Stage::arrive, "all bodies are there and free from the start"}},
       {Stage::detect, stage_of<StructuralSprings>, stage_of<BendSprings>, Stage::integrate}},
      {"[[body]]\nappear = 3\n", {}, {Stage::arrive}},
      {"[[body]]\nrelease = 3\n", {}, {Stage::arrive}},
      {"[collision]\nself_collision = false\n[[body]]\n[dropper]\n", {}, {Stage::detect, stage_of<PenaltyContact>}},
      {"[collision]\nself_collision = false\n[[body]]\n[[body]]\nposition = [5, 5, 5]\n", {}, {Stage::detect}},
  };
  for (const auto& [toml, out, in] : rows) {
    SCOPED_TRACE(toml);
    const World world = world_of(toml);
    for (const auto& [stage, reason] : out) EXPECT_EQ(why(world.plan(), stage), reason);
    for (const Stage stage : in) EXPECT_TRUE(world.plan().has(stage)) << stage_key(stage);
  }
  EXPECT_EQ(world_of(rows[0].toml).plan().shapes, std::vector{&Ground::traits});
}

TEST(Plan, SaysWhichForcesXpbdDoesNotProject) {
  Scene scene = lone_body(gas_ball());
  scene.collision.self_collision = true;
  scene.materials[0][ShapeMatching::frequency] = 3;
  const World world(scene, {});
  for (const Integrator& integrator : integrators())
    EXPECT_EQ(world.plan().unprojected(integrator),
              integrator.key == "xpbd" ? (std::vector{stage_of<ShapeMatching>, stage_of<PenaltyContact>})
                                       : std::vector<Stage>{})
        << integrator.key;
}

TEST(Plan, OfTheDropSceneHasAllButWhatNoneOfItsBodiesAndSolidsNeeds) {
  const World world(drop_scene(), {});
  std::vector<Stage> left_out;
  for (const LeftOut& l : world.plan().left_out) left_out.push_back(l.stage);
  EXPECT_EQ(left_out, (std::vector{Stage::hold, Stage::surface_contact, stage_of<ShearSprings>, stage_of<ShapeMatching>,
                                   stage_of<AirDrag>, stage_of<Hand>, Stage::restitution, Stage::solid_features,
                                   Stage::rebound_damping}));
}

/// Two scenes that differ by a stage which, where it runs, has nothing to do.
struct Idle {
  const char* name;
  Stage stage;
  std::function<void(Scene&)> without, with;
};

class StageLeftOut : public testing::TestWithParam<Idle> {};

TEST_P(StageLeftOut, ChangesNoBitOfTheTrajectory) {
  const Idle& idle = GetParam();
  Scene base = lone_body(gas_ball(), glm::dvec3(1.5, 0.25, -1));
  base.gravity = {0, -9.81, 0};
  base.bodies[0].position = {0, 1, 0};
  set_solid(base, {Ground{0}, 0.5});
  set_solid(base, {SolidSphere{.centre = {1, 0, 0.25}, .radius = 0.5}});
  base.materials[0][Material::start_in_equilibrium] = false;
  Scene absent = base, present = base;
  idle.without(absent);
  idle.with(present);
  for (const std::optional<int> substeps : {std::optional<int>(), std::optional(80)}) {  // many: momenta are kept
    World a(absent, {.integrator = {.substeps = substeps}}), b(present, {.integrator = {.substeps = substeps}});
    EXPECT_FALSE(a.plan().has(idle.stage));
    EXPECT_TRUE(b.plan().has(idle.stage));
    for (int frame = 0; frame < 90; ++frame) {
      a.step();
      b.step();
      for (Index i = 0; i < a.bodies().size(0); ++i) {
        const Particle p = a.particle(0, i), q = b.particle(0, i);
        ASSERT_EQ(p.position, q.position) << "frame " << frame;
        ASSERT_LT(glm::distance(p.velocity, q.velocity), 1e-20) << "an exact 0 may become 1e-30 times something";
      }
    }
    EXPECT_GT(glm::distance(motion(a, 0).centre, base.bodies[0].position), 0.1) << "and it did move";
  }
}

using Edit = std::function<void(Scene&)>;

void nothing(Scene&) {}
Edit set(const Key& key, double value) {
  return [&key, value](Scene& s) { s.materials[0][key] = value; };
}
/// Two edits, one after the other.
Edit both(const Edit& first, const Edit& second) {
  return [=](Scene& s) { first(s), second(s); };
}
void sheet(Scene& s) { s.bodies[0].mesh = {.kind = "grid", .columns = 5, .rows = 5, .width = 1, .depth = 1}; }
void far_sphere(Scene& s) { set_solid(s, {SolidSphere{.centre = {3000, 0, 0}}}); }
void no_solids(Scene& s) { s.solids.clear(); }
void no_sphere(Scene& s) { remove_solids<SolidSphere>(s); }
void by_surfaces(Scene& s) { s.contact_surface = ContactSurface::surfaces; }
void touching_itself(Scene& s) { s.collision.self_collision = true, s.collision.tolerance = 1e-6f; }

const Idle idle_stages[]{
    {"solids", Stage::solids, no_solids,
     [](Scene& s) {
       s.solids = {{SolidSphere{.centre = {3000, 0, 0}}},
                   {Ground{.height = -3000}},
                   {SolidPlane{.point = {0, -3000, 0}, .normal = {0, 0.8, 0.6}}},
                   {SolidBox{.centre = {3000, 0, 0}}},
                   {SolidCapsule{.from = {3000, 0, 0}, .to = {3000, 1, 0}}}};
     }},
    {"enabled_solids", Stage::solids,
     [](Scene& s) {
       for (Solid& solid : s.solids) solid.enabled = false;
     },
     both(no_solids, far_sphere)},
    {"features", Stage::solid_features, both(by_surfaces, no_sphere), both(by_surfaces, far_sphere)},
    {"restitution", Stage::restitution, nothing,
     [](Scene& s) {
       add_solid(s, {.shape = SolidSphere{.centre = {3000, 0, 0}}, .restitution = 1});
     }},
    {"detect", Stage::detect, nothing, touching_itself},
    {"response", stage_of<PenaltyContact>, nothing, touching_itself},
    {"arrive", Stage::arrive, nothing,
     [](Scene& s) {
       s.bodies.push_back(s.bodies[0]);
       s.bodies[1].appear = s.bodies[1].release = 1000;
     }},
    {"damping", Stage::internal_damping, nothing, set(Material::internal_damping, 1e-30)},
    {"rebound", Stage::rebound_damping, nothing, set(contact::rebound_speed, 1e30)},
    {"rolling", Stage::rolling_resistance, nothing, set(contact::rolling_resistance, 1e-30)},
    {"sleep", Stage::sleep, nothing, [](Scene& s) { s.sleep.speed = 1e-30; }},
    {"gravity", Stage::gravity, [](Scene& s) { s.gravity.y = 0; }, [](Scene& s) { s.gravity.y = -1e-30; }},
    {"shear", stage_of<ShearSprings>, sheet,
     both(sheet, both(set(ShearSprings::stiffness, 1e-30), set(ShearSprings::damping_ratio, 0)))},
    {"bend", stage_of<BendSprings>, set(BendSprings::stiffness, 0),
     both(set(BendSprings::stiffness, 1e-30), set(BendSprings::damping_ratio, 0))},
    {"gas", stage_of<GasPressure>, both(set(GasPressure::inside, 0), set(GasPressure::outside, 0)),
     both(set(GasPressure::inside, 1e-30), set(GasPressure::outside, 0))},
};

INSTANTIATE_TEST_SUITE_P(Stages, StageLeftOut, testing::ValuesIn(idle_stages),
                         [](const auto& i) { return i.param.name; });

}  // namespace THIS_FILE
}  // namespace softbody::test
