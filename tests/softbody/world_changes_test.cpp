#include <gtest/gtest.h>

#include <algorithm>

#include <glm/geometric.hpp>

#include "softbody/integrate/force_stage.h"
#include "softbody/mesh/limits.h"
#include "tests/softbody/helpers.h"
#include "tests/support/change.h"

namespace softbody {
namespace THIS_FILE {

/// `number` bodies of the drop scene's material, in layers of four above the ground.
Scene pile(int number) {
  Scene scene = test::drop_scene();
  scene.bodies.clear();
  tests::remove_solids<SolidSphere>(scene);
  scene.dropper.reset();
  scene.captions.clear();
  for (int i = 0; i < number; ++i) {
    BodySource body;
    body.position = {0.9 * (i % 2) + 0.01 * i, 0.6 + 1.05 * (i / 4), 0.9 * (i / 2 % 2)};
    scene.bodies.push_back(body);
  }
  return scene;
}

std::vector<glm::dvec3> positions(const World& world, BodyId body) {
  std::vector<glm::dvec3> list;
  for (Index i = 0; i < world.model(body).mesh.vertices.size(); ++i) list.push_back(world.particle(body, i).position);
  return list;
}

void expect_consistent(const World& world) {
  const collide::Bodies& bodies = world.bodies();
  ASSERT_EQ(world.state().body_count(), bodies.count());
  const collide::Frame frame = world.positions();
  for (BodyId b = 0; b < bodies.count(); ++b) {
    ASSERT_EQ(world.bodies().body_of(bodies.first[b]), b);
    ASSERT_EQ(world.bodies().body_of(bodies.first[b + 1] - 1), b);
    const glm::dvec3 first = world.particle(b, 0).position;
    ASSERT_EQ(frame.y[bodies.first[b]], float(first.y));
  }
}

std::vector<collide::Contact> true_contacts(const World& world) {
  collide::Workers alone(1);
  collide::Result result;
  collide::find_method("brute-force")->make()->detect(world.positions(), world.collision(), alone, result);
  return result.contacts;
}

TEST(Remove, LeavesContactsTrueAndTheStateFiniteInAPile) {
  for (const ContactSurface surface : {ContactSurface::vertices, ContactSurface::surfaces}) {
    Scene scene = pile(14);
    scene.contact_surface = surface;
    World world(scene, {.threads = 2});
    test::run(world, 60);
    int removed = 0;
    for (int frame = 0; frame < 200; ++frame) {
      if (frame % 20 == 0) {
        const BodyId count = world.bodies().count();
        const BodyId gone = std::array<BodyId, 3>{0, count / 2, count - 1}[std::size_t(removed++ % 3)];
        std::vector<std::vector<glm::dvec3>> others;
        for (BodyId b = 0; b < count; ++b)
          if (b != gone) others.push_back(positions(world, b));
        world.remove(gone);
        ASSERT_EQ(world.bodies().count(), count - 1);
        for (BodyId b = 0; b < count - 1; ++b) ASSERT_EQ(positions(world, b), others[b]);
      }
      expect_consistent(world);
      ASSERT_EQ(world.detection().contacts, true_contacts(world)) << "frame " << frame;
      world.step();
      ASSERT_TRUE(measure(world).finite);
    }
    EXPECT_EQ(world.bodies().count(), 4u);
    EXPECT_LT(measure(world).max_speed, 3);
  }
}

TEST(Remove, LeavesTheOthersAsIfTheBodyHadNeverBeen) {
  Scene three = test::lone_body(test::gas_ball(), {1, 0, 0});
  test::add_body(three, {5, 0, 0}, {0, 3, 0});
  test::add_body(three, {0, 9, 0}, {0, 0, 2});
  Scene two = three;
  two.bodies.erase(two.bodies.begin() + 1);
  World world(three, {}), other(two, {});
  world.remove(1);
  test::run(world, 30);
  test::run(other, 30);
  EXPECT_EQ(world.state_hash(), other.state_hash());
}

TEST(Remove, LeavesAnEmptyWorldThatBodiesMayJoin) {
  World world(pile(1), {});
  world.remove(0);
  test::run(world, 3);
  EXPECT_EQ(world.bodies().count(), 0u);
  EXPECT_TRUE(world.detection().contacts.empty());
  world.drop();
  test::run(world, 3);
  EXPECT_EQ(world.bodies().count(), 1u);
  expect_consistent(world);
}

TEST(Remove, WakesWhatLeantOnTheBody) {
  Scene scene = pile(2);
  scene.bodies[0].mesh = {.kind = "grid", .columns = 24, .rows = 24, .width = 1.5, .depth = 1.5};
  scene.bodies[0].position = {0, 1, 0};
  scene.bodies[0].release = 10000;  // held in the air
  scene.bodies[1].position = {0, 1.55, 0};
  World world(scene, {});
  while (world.frame() < 1500 && !world.body(1).asleep) world.step();
  ASSERT_TRUE(world.body(1).asleep);
  const double lying = test::motion(world, 1).centre.y;
  ASSERT_GT(lying, 1.3) << "on the sheet";
  world.remove(0);
  EXPECT_FALSE(world.body(0).asleep);
  test::run(world, 12);
  EXPECT_NEAR(test::motion(world, 0).centre.y, lying - 0.5 * 9.81 * 0.2 * 0.2, 0.03);
}

TEST(Remove, OpensTheHandThatHoldsTheBody) {
  World world(pile(3), {});
  EXPECT_FALSE(world.plan().has(stage_of<Hand>));
  world.grab(Grab{.body = 1});
  world.remove(2);
  world.remove(0);
  ASSERT_TRUE(world.grabbed());
  EXPECT_EQ(world.grabbed()->body, 0u);
  EXPECT_TRUE(world.plan().has(stage_of<Hand>));
  world.step();
  world.remove(0);
  EXPECT_FALSE(world.grabbed());
  EXPECT_FALSE(world.plan().has(stage_of<Hand>));
  world.step();
}

TEST(Add, GivesABodyItsMomentum) {
  Scene scene = test::lone_body(test::gas_ball());
  World world(scene, {});
  BodySource thrown = scene.bodies[0];
  thrown.position = {0, 5, 0};
  thrown.velocity = {3, -4, 12};
  EXPECT_EQ(world.add(thrown), 1u);
  test::run(world, 60);
  const glm::dvec3 expected = scene.materials[0][Material::mass] * thrown.velocity;
  EXPECT_LT(glm::distance(measure(world).momentum, expected), 1e-3);
  EXPECT_LT(glm::distance(test::motion(world, 1).centre, thrown.position + thrown.velocity), 1e-3);
}

TEST(Add, BringsNewMeshesAndTheStagesOfASecondBody) {
  World world(test::lone_body(test::spring_ball()), {});
  ASSERT_FALSE(world.plan().has(Stage::detect));
  BodySource cloth;
  cloth.mesh.kind = "grid";
  cloth.position = {0, 0.52, 0};
  world.add(cloth);
  EXPECT_TRUE(world.plan().has(Stage::detect));
  EXPECT_TRUE(world.plan().has(stage_of<PenaltyContact>));
  EXPECT_FALSE(world.detection().contacts.empty());
  expect_consistent(world);
}

TEST(Throw, FindsRoomBeforeTheCameraOfEveryScene) {
  for (const std::string& key : scene_keys(SBCOLLIDE_SCENES)) {
    const Scene scene = find_scene(key, SBCOLLIDE_SCENES);
    World world(scene, {});
    const BodyId count = world.bodies().count();
    const glm::dvec3 back = glm::normalize(glm::dvec3(0.5, 0.35, 0.8));  // the way to the eye, more or less
    const auto id = world.throw_body(scene.view.target + scene.view.distance * back, -8.0 * back);
    ASSERT_TRUE(id) << key;
    EXPECT_EQ(*id, count) << key;
    world.step();
    EXPECT_GT(glm::dot(test::motion(world, *id).velocity, -back), 7) << key;
  }
}

TEST(Throw, StartsNoBodyInsideAnother) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double way : {-1.0, 1.0}) {
      World world(test::lone_body(test::spring_ball()), {});  // around the origin
      glm::dvec3 from(0.0), velocity(0.0);
      from[axis] = -1.2 * way, velocity[axis] = 5 * way;
      const auto id = world.throw_body(from, velocity);
      ASSERT_TRUE(id);
      const glm::dvec3 place = test::motion(world, *id).centre;
      EXPECT_GT(glm::length(place), 0.95) << axis << " " << way;
      EXPECT_LT(glm::length(place), 2) << "but soon behind it";
    }
}

TEST(Drop, PutsTwentySideBySideWithoutTouching) {
  World world(pile(4), {});
  world.drop(20);
  ASSERT_EQ(world.bodies().count(), 24u);
  expect_consistent(world);
  for (const collide::Contact& c : world.detection().contacts)
    EXPECT_LT(world.bodies().body_of(c.b), 4u) << "only those of the pile touch one another";
  EXPECT_LT(std::ranges::max(world.positions().y), 12) << "no tower";
}

TEST(Apply, ChangesGravityFromTheNextFrameOn) {
  Scene scene = test::lone_body(test::spring_ball());
  World world(scene, {});
  change(world, [](Scene& s) { s.gravity = {0, 0, 6}; });
  EXPECT_TRUE(world.plan().has(Stage::gravity));
  test::run(world, 30);
  EXPECT_NEAR(test::motion(world, 0).velocity.z, 6 * 0.5, 1e-4);
  change(world, [&](Scene& s) { s.gravity = glm::dvec3(0.0); });
  EXPECT_FALSE(world.plan().has(Stage::gravity));
  test::run(world, 30);
  EXPECT_NEAR(test::motion(world, 0).velocity.z, 6 * 0.5, 1e-4);
}

TEST(Changes, WakeAllBodies) {
  Scene scene = test::lone_body(test::spring_ball());
  scene.sleep = {0.05, 2};
  const std::pair<const char*, void (*)(World&)> changes[]{
      {"method", [](World& w) { change(w, [](Scene& s) { s.method = "brute-force"; }); }},
      {"integrator", [](World& w) { w.set_integrator({"rk4"}); }},
      {"collision", [](World& w) { change(w, [](Scene& s) { s.collision.levels = 5; }); }},
      {"contact surface", [](World& w) { change(w, [](Scene& s) { s.contact_surface = ContactSurface::surfaces; }); }},
      {"gravity", [](World& w) { change(w, [](Scene& s) { s.gravity.z = 6; }); }},
      {"material", [](World& w) { change(w, [](Scene& s) { s.materials[0] = test::gas_ball(); }); }},
      {"solids", [](World& w) { change(w, [](Scene& s) { tests::set_solid(s, {Ground{.height = -9}}); }); }},
      {"particles", [](World& w) { w.set_particles(0, test::particles_of(w)); }},
  };
  for (const auto& [what, change] : changes) {
    World world(scene, {});
    test::run(world, 5);
    ASSERT_TRUE(world.body(0).asleep);
    change(world);
    EXPECT_FALSE(world.body(0).asleep) << what;
  }
}

TEST(Apply, RefusesTheWholeSceneAndChangesNothing) {
  struct Refusal {};
  bool refuse = false;
  World world(pile(3), {.check_work = [&](const auto&, const auto&, const auto&) {
                if (refuse) throw Refusal();
              }});
  test::run(world, 10);
  const std::uint64_t hash = world.state_hash();
  const Scene before = world.scene();
  const collide::Detector* detector = &world.detector();
  const auto wrong = [](const auto& edit) {
    return [&edit](Scene& s) {
      s.gravity.y = -1;
      s.materials[0][Material::mass] = 7;
      s.solids.clear();
      s.method = "grid-hash";
      edit(s);
    };
  };
  EXPECT_THROW(change(world, wrong([](Scene& s) { s.collision.tolerance = 11; })), SceneError);
  EXPECT_THROW(change(world, wrong([](Scene& s) { s.collision.buckets = 0; })), SceneError);
  EXPECT_THROW(change(world, wrong([](Scene& s) { s.collision.cell_size = glm::vec3(1, 0, 1); })), SceneError);
  EXPECT_THROW(change(world, wrong([](Scene& s) { s.gravity.x = 1001; })), SceneError);
  EXPECT_THROW(change(world, wrong([](Scene& s) { s.sleep.frames = 0; })), SceneError);
  EXPECT_THROW(change(world, wrong([](Scene& s) { s.method = "none"; })), SceneError);
  EXPECT_THROW(change(world, wrong([](Scene& s) { s.materials[0][contact::friction] = -1; })), SceneError);
  for (const Solid& solid : {Solid{SolidSphere{.radius = 0}}, Solid{SolidSphere{}, -1}, Solid{Ground{}, 0, 2},
                             Solid{Ground{2e6}}, Solid{SolidBox{.half_size = {1, 0, 1}}},
                             Solid{SolidPlane{.normal = {0, 2, 0}}}, Solid{SolidBox{.axes = glm::dmat3(2)}}})
    EXPECT_THROW(change(world, wrong([&](Scene& s) { s.solids = {solid}; })), SceneError);
  refuse = true;
  EXPECT_THROW(change(world, wrong([](Scene&) {})), Refusal);
  EXPECT_EQ(world.scene(), before);
  EXPECT_EQ(world.state_hash(), hash);
  EXPECT_EQ(&world.detector(), detector);
  change(world, [](Scene& s) { s.gravity.y = -1; });  // no other detection, so nobody asks what it would cost
  EXPECT_EQ(world.scene().gravity.y, -1);
}

TEST(Apply, KeepsBodiesAndFurtherMaterialsOfTheWorld) {
  Scene scene = pile(3);
  World world(scene, {});
  change(world, [](Scene& s) { s.materials.emplace_back().name = "later"; });
  scene.bodies.clear();
  scene.name = "another";
  scene.captions = {{3, "text"}};
  test::run(world, 10);
  const std::uint64_t hash = world.state_hash();
  world.apply(scene);
  EXPECT_EQ(world.scene().bodies.size(), 3u);
  EXPECT_EQ(world.scene().materials.back().name, "later");
  EXPECT_EQ(world.scene().name, "another");
  EXPECT_EQ(world.scene().captions.size(), 1u);
  EXPECT_EQ(world.state_hash(), hash);
}

/// There are two materials, equal but for their names.
TEST(Apply, ChangesAMaterialOfItsOwnBodiesAndOfThoseToCome) {
  Scene scene = test::lone_body(test::spring_ball(), {1, 0, 0});
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].name = "other";
  scene.bodies.push_back(scene.bodies[0]);
  scene.bodies[1].material = 1;
  scene.bodies[1].position.y += 5;
  World world(scene, {});
  test::run(world, 3);
  const double mass = scene.materials[0][Material::mass];
  for (const std::size_t changed : {0u, 1u}) {
    const auto before = positions(world, 0);
    change(world, [&](Scene& s) {
      Material& heavy = s.materials[changed];
      heavy[Material::mass] = 5 * mass;
      heavy[GasPressure::inside] = heavy[GasPressure::outside] = 1000;
      heavy[Material::internal_damping] = 2;
    });
    EXPECT_EQ(positions(world, 0), before);
    EXPECT_EQ(world.model(0).material[Material::mass], 5 * mass);
    EXPECT_EQ(world.model(1).material[Material::mass], changed == 0 ? mass : 5 * mass);
  }
  EXPECT_TRUE(world.plan().has(stage_of<GasPressure>));
  EXPECT_TRUE(world.plan().has(Stage::internal_damping));
  EXPECT_NEAR(glm::length(measure(world).momentum), 2 * 5 * mass, 1e-4);
  EXPECT_EQ(&world.model(world.drop()), &world.model(0));
  test::run(world, 30);
  EXPECT_TRUE(measure(world).finite);
}

TEST(Apply, MovesAddsAndRemovesSolids) {
  World world(pile(1), {});
  for (int i = 0; i < 1500 && !world.all_at_rest(); ++i) world.step();
  ASSERT_TRUE(world.all_at_rest());
  const double low = test::motion(world, 0).centre.y;
  Scene solids = world.scene();
  tests::shape_of<Ground>(solids).height = 0.2;
  world.apply(solids);
  test::run(world, 200);
  EXPECT_NEAR(test::motion(world, 0).centre.y, low + 0.2, 0.02);
  EXPECT_LT(measure(world).max_speed, 0.1);  // lifted, not thrown
  tests::remove_solids<Ground>(solids);
  tests::add_solid(solids, {SolidSphere{.centre = {9, 0, 0}}});
  world.apply(solids);
  EXPECT_EQ(world.plan().shapes, std::vector{&SolidSphere::traits});
  test::run(world, 60);
  EXPECT_LT(test::motion(world, 0).centre.y, low - 4);
}

TEST(Changes, RefuseImplicitStepsOfALargeBody) {
  Scene scene = test::lone_body(test::spring_ball());
  World world(scene, {.integrator = {"implicit"}});
  BodySource large = scene.bodies[0];
  large.position.x += 5;
  large.mesh.subdivisions = 4;
  EXPECT_THROW(world.add(large), SceneError);
  EXPECT_EQ(world.bodies().count(), 1u);
  world.set_integrator({"auto"});
  world.add(large);
  EXPECT_THROW(world.set_integrator({"implicit"}), SceneError);
  EXPECT_EQ(world.integrator_choice().key, "auto");
  test::run(world, 2);
  EXPECT_TRUE(measure(world).finite);
}

/// Does all that hands can do, one thing after another.
std::uint64_t hash_after_much(int threads) {
  World world(pile(10), {.threads = threads, .least_share = 0});
  Scene solids = world.scene();
  Material material = world.scene().materials[0];
  material[contact::friction] = 0.1;
  test::run(world, 20);
  world.grab(Grab{.body = 3, .target = {2, 3, 1}});
  test::run(world, 20);
  world.grab(Grab{.body = 3, .target = {-1, 4, 0}});
  world.drop(3);
  test::run(world, 10);
  world.grab({});
  world.remove(2);
  change(world, [&](Scene& s) { s.materials[0] = material; });
  change(world, [&](Scene& s) { s.gravity = {1, -5, 0}; });
  test::run(world, 20);
  tests::add_solid(solids, {SolidSphere{.centre = {0, 0.5, 0}, .radius = 0.6}});
  change(world, [&](Scene& s) { s.solids = solids.solids; });
  test::run(world, 20);
  return world.state_hash();
}

TEST(Changes, DoNotDependOnTheNumberOfThreads) { EXPECT_EQ(hash_after_much(1), hash_after_much(3)); }

TEST(Drop, RefusesMoreParticlesThanAMachineHolds) {
  World world(pile(10), {});
  const auto before = world.bodies().count();
  test::expect_error("at most 4000000",
                     [&] { world.drop(1 + int(max_particles / world.model(0).mesh.vertices.size())); });
  EXPECT_EQ(world.bodies().count(), before);
  test::run(world, 1);
  world.drop();
  EXPECT_EQ(world.bodies().count(), before + 1);
}

}  // namespace THIS_FILE
}  // namespace softbody
