// A frame's substeps: as many as the bound asks for as bodies change.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "softbody/forces/penalty_law.h"
#include "tests/softbody/helpers.h"
#include "tests/support/world_test_access.h"

namespace softbody::test {
namespace THIS_FILE {

StepBound bound_of(const World& world) {
  State state = WorldTestAccess::solver(world).save().bodies;
  const PenaltyContact penalty;
  const SolidContact solids(state);
  collide::Workers workers(1);
  BatchShares shares(workers);
  std::vector<const Batch*> moving;
  for (const Batch& b : state.batches()) moving.push_back(&b);
  shares.take(std::move(moving), state.particle_count());
  return StepBounds(state, penalty, solids, shares).measure(world.integrator_choice().integrator());
}

TEST(StepBounds, AreOfTheBodyThatNeedsMost) {
  Scene scene = lone_body(gas_ball());
  for (int i = 1; i < 3; ++i) {
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies[std::size_t(i)].position.x += 5 * i;
  }
  for (const std::string key : {"semi-implicit-euler", "imex-euler"}) {
    World world(scene, {.integrator = {key}});
    for (const double size : {1.0, 0.6}) {  // of the second body
      double most = 0;
      for (BodyId body = 0; body < 3; ++body) {
        std::vector<Particle> particles;
        std::vector<glm::dvec3> x;
        for (Index v = 0; v < world.model(body).mesh.vertices.size(); ++v) {
          particles.push_back(world.particle(body, v));
          if (body == 1)
            particles.back().position =
                world.body(1).origin + size * (particles.back().position - world.body(1).origin);
          x.push_back(particles.back().position);
        }
        world.set_particles(body, particles);
        const BodyModel& model = world.model(body);
        const double step = world.integrator_choice().integrator().stable_step(
            stiffness_per_mass(model, measure_surface(model, x),
                               key == "imex-euler" ? Volumes::implicit_ : Volumes::explicit_),
            damping_bound(model) / model.particle_mass);
        most = std::max(most, 0.8 / step);
      }
      const Integrator& integrator = world.integrator_choice().integrator();
      EXPECT_NEAR((1 - integrator.reserve()) * stable_rate(bound_of(world), integrator), most, 1e-4 * most)
          << key << size;
    }
  }
}

/// Their contact is the stiffest for the lighter one.
TEST(StepBounds, AreOfTheLighterBodyInEitherOrder) {
  const auto substeps = [](double first, double second) {
    Scene scene = lone_body(spring_ball());
    scene.materials.push_back(scene.materials[0]);
    scene.materials[0][Material::mass] = first, scene.materials[1][Material::mass] = second;
    for (Material& m : scene.materials) m[contact::stiffness] = 1000;
    add_body(scene, {0, 1.02, 0}, glm::dvec3(0.0));
    scene.bodies[1].material = 1;
    World world(scene, {.integrator = {"semi-implicit-euler"}});
    world.step();
    return world.last_step().substeps;
  };
  const int lighter_first = substeps(0.5, 50);
  EXPECT_GT(lighter_first, 3 * substeps(50, 50));
  EXPECT_NEAR(substeps(50, 0.5), lighter_first, 0.05 * lighter_first);
}

TEST(StepBounds, CountTheStiffnessOfContacts) {
  Scene scene = lone_body(spring_ball());
  scene.materials[0][contact::stiffness] = 1e4;
  scene.collision.tolerance = 1e-4f;
  const std::vector<glm::dvec3> start = World(scene, {}).model(0).start;
  const auto above = [](const glm::dvec3& a, const glm::dvec3& b) { return a.y < b.y; };
  const glm::dvec3 top = *std::max_element(start.begin(), start.end(), above);
  const glm::dvec3 bottom = *std::min_element(start.begin(), start.end(), above);
  add_body(scene, top - bottom + glm::dvec3(0, 5e-5, 0), glm::dvec3(0.0));
  World world(scene, {.integrator = {"semi-implicit-euler"}});
  world.step();
  const BodyModel& model = world.model(0);
  const double own = stiffness_per_mass(model, {}),
               penalty = PenaltyLaw<double>::stiffness_bound(1e4) / model.particle_mass;
  ASSERT_GT(penalty, 4 * own);
  EXPECT_GE(world.last_step().substeps,
            world.frame_time() / world.integrator_choice().integrator().stable_step(
                                     own + penalty, damping_bound(model) / model.particle_mass));
}

/// A tenth of its radius in a substep, at most. Who is far from solids does not count, in the same block or not.
TEST(StepBounds, KeepUpWithASoftBodyNearASolid) {
  Material soft = spring_ball();
  soft[StructuralSprings::stiffness] = soft[BendSprings::stiffness] = 0.1;
  const auto substeps = [&](double height) {
    Scene scene = lone_body(soft, {60, 0, 0});
    scene.bodies[0].position = {0, height, 0};
    set_solid(scene, {Ground{}});
    add_body(scene, {5, 0.6, 0}, {});
    World world(scene, {.integrator = {"semi-implicit-euler"}});
    world.step();
    return world.last_step().substeps;
  };
  EXPECT_EQ(substeps(0.6), 20);
  EXPECT_LT(substeps(60), 5);
}

TEST(StepController, FollowsABodyThatIsCrushedWithinAFrame) {
  for (const double speed : {30.0, 100.0, 300.0, 1000.0}) {
    Scene scene = lone_body(gas_ball(), {0, -speed, 0});
    scene.bodies[0].position = {0, 1, 0};
    set_solid(scene, {Ground{}});
    World world(scene, {});
    const double energy = measure(world).energy;
    for (int frame = 0; frame < 60; ++frame) {
      world.step();
      const Measures m = measure(world);
      ASSERT_TRUE(m.finite) << speed << " m/s, frame " << frame;
      EXPECT_LT(m.energy, energy + 1e-3 * speed * speed) << speed << " m/s, frame " << frame;
      EXPECT_LT(m.max_speed, 3 * speed) << speed << " m/s, frame " << frame;
    }
  }
}

/// At rest, but far from its balance: no speed tells yet how soon it will have another shape, and another bound. Then
/// it is fast: a step by the bound of its present shape would lead right through its own far side.
TEST(StepController, FollowsABodyThatSnapsBack) {
  for (const double stretch : {2.0, 3.0, 5.0, 10.0, 20.0, 50.0})
    for (const double stiffness : {1e1, 1e2, 1e3, 1e4})
      for (const double frame_time : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
        Material m = gas_ball();
        m.set(StructuralSprings::keys, {stiffness, 0.1});
        m.set(BendSprings::keys, {stiffness / 4, 0.1});
        m[GasPressure::inside] = 1.6 * stiffness;
        m[GasPressure::outside] = 0;
        World world(lone_body(m), {.frame_time = frame_time});
        place(world, {stretch, 1, 1});
        const double most = 1.05 * measure(world).energy;
        for (int frame = 0; frame < 30; ++frame) {
          world.step();
          ASSERT_LE(measure(world).energy, most)
              << stretch << " times, " << stiffness << " N/m, frame " << frame << " of " << frame_time << " s";
        }
      }
}

/// As small as a scene file may have it: a frame in which it keeps up with the ground takes more than 1e9 substeps. One
/// of the whole frame, in their place, threw all others apart.
TEST(StepController, KeepsOtherBodiesStableWhereOneNeedsTooMany) {
  Scene scene = lone_body(gas_ball());
  scene.gravity = {0, -9.81, 0};
  set_solid(scene, {Ground{}});
  scene.contact_surface = ContactSurface::surfaces;
  add_body(scene, {3, 0.1, 0}, {0, -10, 0});
  scene.bodies[1].mesh.radius = 1e-9;
  World world(scene, {.budget = {.least = 1e6}});
  for (int frame = 0; frame < 5; ++frame) {
    world.step();
    ASSERT_LE(WorldTestAccess::solver(world).steps().spent(), 4e6);
    ASSERT_LT(world.last_step().seconds, world.frame_time());
    ASSERT_LT(measure(world).max_speed, 11) << "frame " << frame;
    ASSERT_LT(measure(world, 0).largest_strain, 0.1) << "frame " << frame;
  }
}

TEST(StepController, FollowsTheBound) {
  Scene scene = lone_body(spring_ball());
  for (const double stiffness : {10.0, 300.0, 30000.0}) {
    scene.materials[0][StructuralSprings::stiffness] = stiffness;
    World world(scene, {});
    const BodyModel& model = world.model(0);
    world.step();
    const double h =
        stable_step(model.forces->pair_stiffness / model.particle_mass, damping_bound(model) / model.particle_mass);
    EXPECT_EQ(world.last_step().needed, int(std::ceil(1.0 / 60 / h)));
    EXPECT_EQ(world.last_step().substeps, on_ladder(1.0 / 60 / h, 8));
  }
}

/// However soft the body and stable the integrator.
TEST(StepController, LimitsStepsToASixtiethOfASecondUnlessFixed) {
  for (const std::string integrator : {"semi-implicit-euler", "implicit", "xpbd"}) {
    const int each = find_integrator(integrator)->substeps_per_step;
    Material soft = spring_ball();
    soft[StructuralSprings::stiffness] = soft[BendSprings::stiffness] = 0.01;
    const auto substeps = [&](double frame_time, std::optional<int> fixed) {
      World world(lone_body(soft), {.frame_time = frame_time, .integrator = {integrator, fixed}});
      world.step();
      return world.last_step().substeps;
    };
    EXPECT_GE(substeps(0.5, {}), 30) << integrator;
    EXPECT_LE(substeps(0.5, {}), 32) << integrator;
    EXPECT_EQ(substeps(1.0 / 60, {}), each) << integrator;
    EXPECT_EQ(substeps(0.5, 1), each) << integrator;
  }
}

/// Slow motion, or implicit steps, whatever the integrator.
TEST(StepController, RefusesNoMaterialHoweverStiff) {
  for (const Integrator& integrator : integrators())
    for (const ContactSurfaceInfo& surface : contact_surfaces)
      for (const double stiffness : {1e9, 1e12}) {
        Scene scene = lone_body(spring_ball());
        scene.materials[0][StructuralSprings::stiffness] = stiffness;
        scene.contact_surface = surface.value;
        add_body(scene, {0, 2, 0}, {});
        World world(scene, {.integrator = {std::string(integrator.key)}, .budget = {.least = 1e6}});
        world.step();
        EXPECT_GT(world.last_step().seconds, 0) << integrator.key;
        EXPECT_TRUE(world.last_step().integrator->stable_at_any_step() ||
                    world.last_step().seconds < world.frame_time());
        EXPECT_TRUE(measure(world).finite) << integrator.key;
      }
}

/// Two balls of 5 kg fall on a sheet of 0.3 kg whose springs are up to 100,000 times as stiff as cloth's, in long
/// frames.
TEST(StepController, TakesStiffScenesInImplicitSteps) {
  for (const double times : {1e3, 1e4, 1e5}) {
    Material ball = gas_ball(), sheet = spring_ball();
    ball[Material::mass] = 5, sheet[Material::mass] = 0.3;
    ball.set(StructuralSprings::keys, {100 * times, 0.1});
    sheet.set(StructuralSprings::keys, {50 * times, 0.1});
    Scene scene = lone_body(ball);
    scene.materials.push_back(sheet);
    scene.gravity = {0, -9.81, 0};
    set_solid(scene, {Ground{}});
    scene.bodies[0].position = {0, 1, 0};
    add_body(scene, {0.3, 2.2, 0}, {});
    add_body(scene, {0, 0.3, 0}, {});
    scene.bodies[2].material = 1;
    scene.bodies[2].mesh = {.kind = "grid", .columns = 10, .rows = 10, .width = 2, .depth = 2};
    World world(scene, {.frame_time = 1.0 / 30});
    for (int frame = 0; frame < 30; ++frame) {
      world.step();
      ASSERT_EQ(world.last_step().seconds, world.frame_time()) << times << " in frame " << frame;
      ASSERT_TRUE(measure(world).finite);
      ASSERT_LT(measure(world).max_speed, 20) << times << " in frame " << frame;
    }
  }
}

/// A hard throw against a solid: however it deforms, the step that was chosen has to carry it.
TEST(StepController, KeepsACrushedBodyInOnePiece) {
  for (const double speed : {3.0, 10.0, 30.0}) {
    Scene scene = lone_body(gas_ball(), glm::dvec3(0, -speed, 0));
    scene.bodies[0].position = {0, 1, 0};
    set_solid(scene, {Ground{}});
    World world(scene, {});
    const double before = measure(world).energy, kinetic = 0.5 * speed * speed;
    for (int i = 0; i < 120; ++i) {
      world.step();
      const Measures m = measure(world);
      ASSERT_TRUE(m.finite) << "frame " << i;
      ASSERT_LT(m.max_speed, 3 * speed);
      ASSERT_LT(m.energy, before + 0.1 * kinetic) << "frame " << i << " at " << speed << " m/s";
    }
    EXPECT_GT(measure(world).volume_ratio_min, 0.9);
  }
}

}  // namespace THIS_FILE
}  // namespace softbody::test
