// A frame's substeps: as many as the bound asks for as bodies change.

#include <gtest/gtest.h>

#include "softbody/forces/penalty_law.h"
#include "tests/softbody/helpers.h"
#include "tests/support/world_test_access.h"

namespace softbody::test {
namespace THIS_FILE {

TEST(StepBounds, AreOfTheBodyThatNeedsMost) {
  const auto model = make_body_model({}, gas_ball());
  for (const char* key : {"semi-implicit-euler", "imex-euler"})
    for (const double size : {1.0, 0.6}) {  // of the second body
      const Integrator& integrator = *find_integrator(key);
      State state;
      double most = 0;
      for (BodyId id = 0; id < 3; ++id) {
        const glm::dvec3 origin(5.0 * id, 0, 0);
        state.add(model, origin, glm::dvec3(0.0));
        std::vector<glm::dvec3> x;
        std::vector<Particle> particles;
        for (const glm::dvec3& v : model->start) {
          x.push_back((id == 1 ? size : 1) * v);
          particles.push_back({origin + x.back(), glm::dvec3(0.0)});
        }
        state.set_particles(id, particles);
        const Volumes volumes = integrator.implicit_volume ? Volumes::implicit_ : Volumes::explicit_;
        const double stiffness = stiffness_per_mass(*model, measure_surface(*model, x), volumes);
        most = std::max(most, 0.8 / integrator.stable_step(stiffness, damping_bound(*model) / model->particle_mass));
      }
      const PenaltyContact penalty;
      const SolidContact solids(state);
      collide::Workers workers(1);
      BatchShares shares(workers);
      shares.take({&state.batches()[0]}, state.particle_count());
      const StepBound bound = StepBounds(state, penalty, solids, shares).measure(integrator);
      EXPECT_NEAR((1 - integrator.reserve()) * stable_rate(bound, integrator), most, 1e-4 * most) << key << size;
    }
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

TEST(StepBounds, ReckonWithTheRoundingOfTheFarthestPosition) {
  Batch batch;
  batch.used = 2;
  batch.moves[0] = 1;  // the second body stands
  Extent extent{};
  extent.lo.set(0, {0, -3, 0});
  extent.hi.set(0, {2, -1, 1});
  extent.hi.set(1, {9, 0, 0});
  const Batch* const moving = &batch;
  EXPECT_EQ(StepBounds::rounding({&moving, 1}, {&extent, 1}), 3.0 / (1 << 24));
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
  for (const double speed : {30.0, 300.0, 1000.0}) {
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
  for (const double stretch : {2.0, 10.0, 50.0})
    for (const double stiffness : {1e1, 1e3})
      for (const double frame_time : {1.0 / 30, 1.0 / 240}) {
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

}  // namespace THIS_FILE
}  // namespace softbody::test
