// Bodies that start turned or spinning, vertices that are held, and air, by every integrator.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "softbody/contact/solid_surface.h"
#include "softbody/forces/air_drag.h"
#include "softbody/integrate/integrators.h"
#include "softbody/state/state.h"
#include "softbody/world/energy_watch.h"
#include "softbody/world/snapshot.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

Material cloth() {
  Material m = spring_ball();
  m[Material::mass] = 0.5;
  m[Material::internal_damping] = 5;
  return m;
}

/// A sheet of 1 m, 8 x 8 quads, in the plane y = 0, without gravity.
Scene sheet(const std::vector<Hold>& holds) {
  Scene s = lone_body(cloth());
  s.bodies[0].mesh = {.kind = "grid", .columns = 8, .rows = 8, .width = 1, .depth = 1};
  s.bodies[0].position = glm::dvec3(0.0);
  s.bodies[0].holds = holds;
  return s;
}

/// The edge of the sheet at x = -0.5, or at 0.5.
Hold edge(double x) { return {.where = SolidBox{.centre = {x, 0, 0}, .half_size = {0.01, 0.01, 1}}}; }

constexpr glm::dvec3 down{0, -9.81, 0};

bool is_at(const Hold& hold, const glm::dvec3& place) { return surface_at(Solid{hold.where}, place).distance <= 1e-9; }

class Holds : public testing::TestWithParam<const char*> {
 protected:
  World world(const Scene& scene) const { return World(scene, {.integrator = {.key = GetParam()}}); }
};
INSTANTIATE_TEST_SUITE_P(Integrators, Holds,
                         testing::Values("explicit-euler", "semi-implicit-euler", "imex-euler", "velocity-verlet",
                                         "rk4", "xpbd", "implicit"),
                         [](const auto& param) {
                           std::string name = param.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST_P(Holds, KeepVerticesWhereTheyAreToTheBitWhileTheRestHangs) {
  Scene s = sheet({edge(-0.5)});
  s.gravity = down;
  World w = world(s);
  const std::vector<Particle> start = particles_of(w);
  run(w, 30);
  const std::vector<Particle> end = particles_of(w);
  double lowest = 0;
  for (std::size_t i = 0; i < start.size(); ++i) {
    ASSERT_TRUE(std::isfinite(end[i].position.y));
    lowest = std::min(lowest, end[i].position.y);
    if (!is_at(edge(-0.5), start[i].position)) continue;
    EXPECT_EQ(end[i].position, start[i].position);
    EXPECT_EQ(end[i].velocity, glm::dvec3(0.0));
  }
  EXPECT_LT(lowest, -0.02);
  EXPECT_GT(lowest, -1.2);
}

TEST_P(Holds, CarryAndTurnVerticesAsTheyAreTold) {
  Hold moving = edge(0.5);
  moving.velocity = {0, 0.25, 0};
  moving.turn = {.axis = {1, 0, 0}, .degrees_per_second = 180};
  moving.through = {0.5, 0, 0.1};
  World w = world(sheet({edge(-0.5), moving}));
  const std::vector<Particle> start = particles_of(w);
  run(w, 30);
  for (std::size_t i = 0; i < start.size(); ++i) {
    if (!is_at(moving, start[i].position)) continue;
    const glm::dvec3 out = start[i].position - moving.through;  // a quarter turn about x: z comes to -y
    const glm::dvec3 place = moving.through + 0.5 * moving.velocity + glm::dvec3(out.x, -out.z, out.y);
    EXPECT_LT(glm::distance(w.particle(0, Index(i)).position, place), 2e-5);
  }
}

TEST_P(Holds, LetGoInTheirFrame) {
  Hold short_one = edge(-0.5);
  short_one.until = 10;
  Scene s = sheet({short_one});
  s.gravity = down;
  World w = world(s);
  run(w, 10);
  EXPECT_EQ(w.particle(0, 0).position.y, 0);
  run(w, 30);
  EXPECT_NEAR(motion(w, 0).velocity.y, -9.81 * 40 / 60, 9.81 * 12 / 60) << "it falls";
  EXPECT_LT(w.particle(0, 0).position.y, -0.5);
}

TEST_P(Holds, BookWhatTheyDo) {
  Hold pulling = edge(0.5);
  pulling.velocity = {0.5, 0, 0};
  Scene s = sheet({edge(-0.5), pulling});
  World w = world(s);
  EnergyWatch watch;
  watch.look(w, measure_bodies(w));
  const double before = total(measure_bodies(w)).energy;
  for (int i = 0; i < 30; ++i) {
    w.step();
    const auto change = watch.look(w, measure_bodies(w));
    ASSERT_FALSE(change->from_nowhere()) << i << ": " << change->gain << " J of " << change->active;
  }
  const double grown = total(measure_bodies(w)).energy - before, booked = ledger(w).booked(WorkBy::holds);
  EXPECT_GT(booked, 1);
  EXPECT_EQ(booked, ledger(w).total() - ledger(w).booked(WorkBy::user) - ledger(w).booked(WorkBy::steps));
  if (w.last_step().integrator->conserves_energy) {
    EXPECT_NEAR(grown, booked, 0.1 * booked);
  }
}

/// A weight on a spring of 2 x 1 vertices of which one side is held: m x'' = -2 k x, along the two edges.
TEST_P(Holds, HaveAnInfiniteMass) {
  Material m = spring_ball();
  m[Material::mass] = 4;  // 1 kg a vertex
  m.set(StructuralSprings::keys, {50, 0});
  m.set(BendSprings::keys, {0, 0});
  Scene s = sheet({edge(-0.5)});
  s.materials[0] = m;
  s.bodies[0].mesh = {.kind = "grid", .columns = 1, .rows = 1, .width = 1, .depth = 1};
  World w(s, {.frame_time = 1e-3, .integrator = {.key = GetParam()}});
  const StructuralSprings::Data& springs = *data<StructuralSprings>(w.model(0));
  double k = 0;
  Index moving = 0;
  for (Index i = 0; i < 4; ++i)
    if (w.particle(0, i).position.x > 0) moving = i;
  for (const auto& law : springs.exact)
    if ((law.i == moving) != (law.j == moving) && w.particle(0, law.i).position.z == w.particle(0, law.j).position.z)
      k = law.stiffness;
  ASSERT_GT(k, 0);
  std::vector<Particle> stretched = particles_of(w);
  for (Particle& p : stretched)
    if (p.position.x > 0) p.position.x += 0.01;
  w.set_particles(0, stretched);
  const double rate = std::sqrt(k / w.model(0).particle_mass);
  for (int frame = 1; frame <= 600; ++frame) {
    w.step();
    if (std::string(GetParam()) == "explicit-euler") continue;  // it is not stable without damping
    ASSERT_NEAR(w.particle(0, moving).position.x, 0.5 + 0.01 * std::cos(rate * frame * 1e-3), 4e-4) << frame;
  }
}

TEST_P(Holds, OfFineMeshesHoldTheParticlesThatCarryTheirVertices) {
  const TemporaryFolder folder;
  const Mesh sphere = icosphere(4, 0.5);  // of 2,562 vertices
  std::string obj;
  for (const glm::dvec3& v : sphere.vertices)
    obj += "v " + std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z) + "\n";
  for (const auto& [a, b, c] : sphere.triangles)
    obj += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " + std::to_string(c + 1) + "\n";
  folder.write("ball.obj", obj);
  const Hold top{.where = SolidSphere{.centre = {0, 3.5, 0}, .radius = 0.1}};
  World w = world(load_scene(folder.write("s.toml",
                                          "[[material]]\nmass = 0.5\n[[body]]\nmesh = {kind = \"file\", path = "
                                          "\"ball.obj\", resolution = 100}\nposition = [0, 3, 0]\nhold = [{sphere = "
                                          "{centre = [0, 3.5, 0], radius = 0.1}}]\n")));
  const auto fine = [&](Index i) { return glm::dvec3(w.positions().x[i], w.positions().y[i], w.positions().z[i]); };
  std::vector<glm::dvec3> before;
  for (Index i = 0; i < w.bodies().vertex_count(); ++i) before.push_back(fine(i));
  run(w, 20);
  int held = 0;
  for (Index i = 0; i < before.size(); ++i) {
    if (!is_at(top, before[i])) continue;
    EXPECT_LT(glm::distance(fine(i), before[i]), 0.01);
    ++held;
  }
  EXPECT_GT(held, 3);
  EXPECT_LT(motion(w, 0).centre.y, 3 - 1e-3) << "the rest sags";
}

TEST_P(Holds, CarryBodiesByBothContacts) {
  if (std::string(GetParam()) == "explicit-euler") return;  // it takes thousands of steps a frame
  for (const ContactSurface contact : {ContactSurface::vertices, ContactSurface::surfaces}) {
    Hold border{.where = SolidBox{.centre = {0, 0, 0}, .half_size = {1, 0.01, 1}}};  // the whole sheet, lifted
    border.velocity = {0, 0.5, 0};
    Scene s = sheet({border});
    s.gravity = down;
    s.contact_surface = contact;
    s.collision.tolerance = 0.15f;
    s.materials.push_back(damped(gas_ball()));
    for (Material& m : s.materials) m[contact::stiffness] = 400;
    s.bodies.push_back({.mesh = {.subdivisions = 1, .radius = 0.2}, .material = 1, .position = {0, 0.4, 0}});
    World w = world(s);
    EnergyWatch watch;
    for (int i = 0; i < 60; ++i) {
      w.step();
      const auto change = watch.look(w, measure_bodies(w));
      ASSERT_FALSE(change && change->from_nowhere()) << i << ": " << change->gain << " J of " << change->active;
    }
    EXPECT_NEAR(w.particle(0, 0).position.y, 0.5, 1e-3);
    EXPECT_GT(motion(w, 1).centre.y, 0.5 + 0.05) << "it lies on the sheet";
    EXPECT_LT(motion(w, 1).centre.y, 1.1);
  }
}

/// The sphere lies between the vertices of a sheet of one quad that is held at all but a corner.
TEST_P(Holds, BookWhatTheyDoAgainstSolids) {
  Scene s = sheet({edge(-0.5), {.where = SolidSphere{.centre = {0.5, 0, 0.5}, .radius = 0.1}}});
  for (Hold& hold : s.bodies[0].holds) hold.velocity = {0, -0.5, 0};
  s.bodies[0].mesh.columns = s.bodies[0].mesh.rows = 1;
  s.contact_surface = ContactSurface::surfaces;
  s.solids = {Solid{SolidSphere{.centre = {0.2, -0.3, -0.1}, .radius = 0.2}}};
  World w = world(s);
  EnergyWatch watch;
  for (int i = 0; i < 60; ++i) {
    w.step();
    const auto change = watch.look(w, measure_bodies(w));
    ASSERT_FALSE(change && change->from_nowhere()) << i << ": " << change->gain << " J of " << change->active;
  }
}

TEST_P(Holds, GoOnFromASnapshotToTheBit) {
  Hold moving = edge(0.5);
  moving.turn = {.axis = {1, 0, 0}, .degrees_per_second = 90};
  moving.velocity = {-0.1, 0, 0};
  World w = world(sheet({edge(-0.5), moving}));
  run(w, 5);
  const Snapshot snapshot = w.snapshot();
  run(w, 5);
  const std::uint64_t hash = w.state_hash();
  w.restore(snapshot);
  run(w, 5);
  EXPECT_EQ(w.state_hash(), hash);
}

TEST(HoldsOfAScene, ThatHoldNothingAreNamed) {
  Scene s = sheet({edge(-0.5), edge(5)});
  expect_error("hold[1] of the body at [0, 0, 0] holds no vertex; put it where the body, and each copy of a lattice,",
               [&] { World(s, {}); });
  s.bodies[0].appear = 9;
  expect_error("hold[1]", [&] { World(s, {}); });
  World w(sheet({}), {});
  expect_error("hold[0]", [&] { w.add({.mesh = {}, .holds = {edge(5)}}); });
  s.bodies[0].holds[1] = {.vertices = {80, 81}};
  expect_error("hold[1] of the body at [0, 0, 0] holds vertex 81; the last one is 80", [&] { World(s, {}); });
  EXPECT_EQ(w.bodies().count(), 1u);
  EXPECT_EQ(w.state().body_count(), 1u);
}

TEST(HoldsOfAScene, OfABodyThatIsAddedLastAsLongAsTheySay) {
  World w(sheet({}), {});
  Hold all{.where = SolidSphere{.centre = {0, 5, 0}, .radius = 2}, .until = 5};
  all.velocity = {0, 1, 0};
  const BodyId added = w.add({.mesh = {}, .position = {0, 5, 0}, .holds = {all}});
  run(w, 5);
  EXPECT_NEAR(motion(w, added).centre.y, 5 + 5.0 / 60, 1e-5);
  EXPECT_TRUE(w.state().body(added).memory.holds[0].on);
  run(w, 1);
  EXPECT_FALSE(w.state().body(added).memory.holds[0].on);
}

TEST(HoldsOfAScene, KeepTheBodyAwakeWhereTheyMoveIt) {
  for (const double speed : {0.0, 0.01}) {
    Hold all{.where = SolidSphere{.centre = {0, 0, 0}, .radius = 2}};
    all.velocity.x = speed;
    Scene s = sheet({all});
    s.sleep = {.speed = 0.03, .frames = 5};
    World w(s, {});
    run(w, 60);
    EXPECT_EQ(w.body(0).asleep, speed == 0);
    EXPECT_NEAR(motion(w, 0).centre.x, speed, 1e-5);
  }
}

TEST(HoldsOfAScene, ThatAreStillToEndLeaveNothingAtRest) {
  Scene s = sheet({{.where = SolidSphere{.radius = 2}, .until = 40}});
  s.gravity = down;
  s.sleep = {.speed = 0.03, .frames = 5};
  World w(s, {});
  for (const int frames : {30, 10}) {
    run(w, frames);
    EXPECT_TRUE(w.body(0).asleep);
    EXPECT_FALSE(w.all_at_rest()) << w.frame();
  }
  run(w, 1);
  EXPECT_FALSE(w.body(0).asleep) << "it has been let go";
}

TEST(SwitchHold, HoldsAParticleAndLetsGoOfIt) {
  Scene s = lone_body(spring_ball());
  s.gravity = down;
  World w(s, {});
  const Plan without = w.plan();
  EXPECT_FALSE(without.has(Stage::hold));
  run(w, 5);
  w.switch_hold(0, 3);
  EXPECT_TRUE(w.plan().has(Stage::hold));
  const glm::dvec3 place = w.particle(0, 3).position;
  run(w, 5);
  EXPECT_EQ(w.particle(0, 3).position, place);
  w.switch_hold(0, 3);
  run(w, 5);
  EXPECT_GT(glm::distance(w.particle(0, 3).position, place), 0.01);
}

TEST(Bodies, StartTurnedAndSpinAboutTheirMiddle) {
  for (const Integrator& integrator : integrators()) {
    SCOPED_TRACE(integrator.key);
    Scene s = sheet({});
    s.bodies[0].axes = glm::dmat3(glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1));
    s.bodies[0].position = {1, 2, 3};
    s.bodies[0].velocity = {0.5, 0, 0};
    s.bodies[0].spin = {.axis = {0, 1, 0}, .degrees_per_second = 90};
    World w(s, {.integrator = {.key = std::string(integrator.key)}});
    EXPECT_NEAR(w.particle(0, 0).position.x, 1, 1e-6) << "upright";
    const Motion start = motion(w, 0);
    EXPECT_LT(glm::distance(start.velocity, glm::dvec3(0.5, 0, 0)), 1e-6);
    const double inertia =
        w.model(0).material[Material::mass] * 1.25 / 12;  // of the depth, 8 quads: 10 / 8 of a plate's
    EXPECT_NEAR(start.spin_momentum.y, inertia * std::numbers::pi / 2, 1e-4);
    run(w, 10);
    EXPECT_LT(glm::distance(motion(w, 0).centre, glm::dvec3(1 + 0.5 / 6, 2, 3)), 1e-4);
    EXPECT_NEAR(motion(w, 0).spin_momentum.y, start.spin_momentum.y, 2e-2 * start.spin_momentum.y);
  }
}

/// v = w + (g m / c) (1 - e^(-c t / m)), in a wind w.
TEST(AirDrag, BringsBodiesToTheirTerminalVelocity) {
  for (const Integrator& integrator : integrators()) {
    SCOPED_TRACE(integrator.key);
    Material m = spring_ball();
    m[Material::mass] = 2;
    m[AirDrag::drag] = 8;
    Scene s = lone_body(m);
    s.gravity = down;
    s.wind = {3, 0, 0};
    World w(s, {.integrator = {.key = std::string(integrator.key)}});
    EnergyWatch watch;
    for (int i = 0; i < 60; ++i) {
      w.step();
      const auto change = watch.look(w, measure_bodies(w));
      ASSERT_FALSE(change && change->from_nowhere()) << i;
    }
    const double gone = 1 - std::exp(-4.0);
    EXPECT_NEAR(motion(w, 0).velocity.y, -9.81 / 4 * gone, 0.01) << "of 2.4 m/s";
    EXPECT_NEAR(motion(w, 0).velocity.x, 3 * gone, 0.01);
    EXPECT_GT(ledger(w).booked(WorkBy::wind), 0.5 * 2 * 9 * gone * gone);
  }
}

}  // namespace THIS_FILE
}  // namespace softbody::test
