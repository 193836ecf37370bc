// Whole bodies that bounce, with every integrator and by both kinds of contact.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "softbody/integrate/integrators.h"
#include "softbody/world/energy_watch.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

constexpr double radius = 0.5, g = 9.81;
constexpr std::array both{ContactSurface::vertices, ContactSurface::surfaces};

/// Smooth ground or a smooth ball below y = 0.
Scene solid(bool flat, double restitution) {
  Scene scene;
  if (flat)
    set_solid(scene, {Ground{0}, 0, restitution});
  else
    set_solid(scene,
              {.shape = SolidSphere{.centre = {0, -1, 0}, .radius = 1}, .friction = 0, .restitution = restitution});
  return scene;
}

/// A coarse ball that comes down on something at `speed`.
Scene falling_ball(const Material& material, Scene onto, double speed) {
  Scene scene = lone_body(material, {0, -speed, 0});
  scene.gravity = {0, -g, 0};
  scene.bodies[0].mesh.subdivisions = 1;
  scene.bodies[0].position = {0, radius + 0.05, 0};
  scene.solids = std::move(onto.solids);
  return scene;
}

/// How high the centre of a world's first body comes after it has hit something, until it falls again, and the energy
/// that comes from nowhere until then.
struct Rise {
  double height = 0;  // m
  double gain = 0;    // J
};
Rise rise(World& world, int frames) {
  Rise found;
  EnergyWatch watch;
  const double start = measure(world).energy;
  bool has_hit = false;
  for (int i = 0; i < frames; ++i) {
    world.step();
    const auto change = watch.look(world, measure_bodies(world));
    if (change && change->from_nowhere()) found.gain += change->gain;
    found.gain = std::max(found.gain, measure(world).energy - start);
    const Motion m = motion(world, 0);
    has_hit = has_hit || m.velocity.y > 0;
    if (has_hit) found.height = std::max(found.height, m.centre.y);
    if (has_hit && m.centre.y < found.height - 0.02 && m.velocity.y < -0.2) break;
  }
  return found;
}

class BounceBy : public testing::TestWithParam<Integrator> {};

TEST_P(BounceBy, IsHigherTheMoreRestitutionThereIs) {
  struct Case {
    bool flat;
    ContactSurface by;
    double speed;  // m/s
    bool of_solid;
    double more;  // m, least gain of height from restitution 0 to 1
  };
  Material material;  // as it is if a scene says nothing
  for (Material base : {material, damped(gas_ball())})
    for (const auto& [flat, by, speed, of_solid, more] :
         {Case{true, ContactSurface::vertices, 7, true, 0.2}, Case{false, ContactSurface::surfaces, 7, false, 0.2},
          Case{true, ContactSurface::surfaces, 3, false, 0.03}, Case{false, ContactSurface::vertices, 3, true, 0.03}}) {
      SCOPED_TRACE(testing::Message() << base.name << (flat ? ", flat, " : ", round, ") << speed << " m/s");
      Rise without;
      double before = 0;
      for (const double e : {0.0, 0.5, 1.0}) {
        base[contact::restitution] = of_solid ? 0 : e;
        Scene scene = falling_ball(base, solid(flat, of_solid ? e : 0), speed);
        scene.contact_surface = by;
        World world(std::move(scene), {.integrator = {std::string(GetParam().key), std::nullopt}});
        const Rise with = rise(world, 120);
        if (e == 0) without = with;
        EXPECT_GT(with.height, before - 0.02) << "m, restitution " << e;
        EXPECT_LT(with.gain, without.gain + 0.2) << "J, restitution " << e;
        before = with.height;
      }
      EXPECT_GT(before, without.height + more) << "m";
      EXPECT_LT(without.gain, 0.2) << "J";
    }
}

/// All but explicit Euler, which needs very many substeps.
std::vector<Integrator> bouncing_integrators() {
  std::vector<Integrator> all(integrators().begin(), integrators().end());
  std::erase_if(all, [](const Integrator& i) { return i.key == "explicit-euler"; });
  return all;
}

INSTANTIATE_TEST_SUITE_P(Table, BounceBy, testing::ValuesIn(bouncing_integrators()), [](const auto& i) {
  std::string name(i.param.key);
  std::erase(name, '-');
  return name;
});

/// Balls of one mass that meet head-on swap their velocities if contact takes nothing.
TEST(Bounce, OfTwoBodiesKeepsTheirMomentumAndNearlySwapsTheirVelocities) {
  Material material = gas_ball();
  for (const Key* damping : {&StructuralSprings::damping_ratio, &BendSprings::damping_ratio}) material[*damping] = 0;
  for (const auto& [by, integrator] : {std::pair(both[0], "auto"), std::pair(both[1], "auto"),
                                       std::pair(both[0], "implicit"), std::pair(both[1], "implicit")}) {
    double before = -1, without = 0;
    for (const double e : {0.0, 0.5, 1.0}) {
      SCOPED_TRACE(testing::Message() << int(by) << ", " << integrator << ", restitution " << e);
      material[contact::restitution] = e;
      Scene scene = lone_body(material, {3, 0, 0});
      add_body(scene, {1.3, 0, 0}, {-1, 0, 0});
      for (BodySource& body : scene.bodies) body.mesh.subdivisions = 1;
      scene.contact_surface = by;
      World world(std::move(scene), {.integrator = {integrator, std::nullopt}});
      const double energy = measure(world).energy;
      run(world, 90);
      const glm::dvec3 a = motion(world, 0).velocity, b = motion(world, 1).velocity;
      EXPECT_LT(glm::distance(a + b, glm::dvec3(2, 0, 0)), 1e-3);
      EXPECT_GE(b.x - a.x, before - 0.02);
      EXPECT_LE(b.x - a.x, 4.001);
      EXPECT_LE(measure(world).energy, energy + 0.1);
      before = b.x - a.x;
      if (e == 0) without = before;
    }
    EXPECT_GT(before, without + (by == ContactSurface::vertices ? 0.1 : -0.02));
    EXPECT_GT(before, 3.2) << "m/s; they come together with 4";
  }
}

/// A sheet that is all held, of another mass, or held at two sides, stiff or slack.
TEST(Bounce, OnAHeldSheetReturnsToTheBallAloneAndGainsNothing) {
  struct Sheet {
    double mass, stiffness;
    bool all_held;
  };
  const auto bounce = [](const Sheet& sheet, double restitution) {
    Material ball = damped(gas_ball());
    ball[contact::restitution] = restitution;
    Scene scene = falling_ball(ball, {}, 4);
    Material& cloth = scene.materials.emplace_back(spring_ball());
    cloth[Material::mass] = sheet.mass;
    cloth.set(StructuralSprings::keys, {sheet.stiffness, 0.05});
    BodySource& body = scene.bodies.emplace_back();
    body = {.mesh = {.kind = "grid", .columns = 12, .rows = 12, .width = 1.6, .depth = 1.6}, .material = 1};
    for (const double x : {-0.8, 0.8})
      body.holds.push_back({.where = SolidBox{.centre = {x, -0.1, 0}, .half_size = {0.1, 0.1, 1}}});
    if (sheet.all_held) body.holds = {{.where = SolidSphere{.centre = {0, -0.1, 0}, .radius = 2}}};
    body.position = {0, -0.1, 0};
    scene.contact_surface = ContactSurface::surfaces;
    World world(std::move(scene), {});
    return rise(world, 120);
  };
  const Sheet light{0.25, 200, true}, heavy{250, 200, true};
  EXPECT_NEAR(bounce(light, 0.8).height, bounce(heavy, 0.8).height, 2e-3) << "m: it does not move";
  EXPECT_GT(bounce(light, 0.8).height, bounce(light, 0).height + 0.1) << "m";
  for (const double stiffness : {2000.0, 200.0}) EXPECT_LT(bounce({0.25, stiffness, false}, 0.8).gain, 1e-6) << "J";
}

/// Contact of surfaces acts after an implicit step, which must not press gas and springs together meanwhile.
TEST(ImplicitBounce, OfTwoBodiesBySurfacesGainsNoEnergy) {
  Scene scene = lone_body(gas_ball(), {8, 0, 0});
  add_body(scene, {1.15, 0, 0}, {0, 0, 0});
  for (BodySource& body : scene.bodies) body.mesh.subdivisions = 1;
  scene.contact_surface = ContactSurface::surfaces;
  World world(std::move(scene), {.integrator = {"implicit", std::nullopt}});
  EXPECT_LT(rise(world, 60).gain, 0.1) << "J";
  EXPECT_GT(motion(world, 1).velocity.x, 4) << "m/s: they have met";
}

}  // namespace THIS_FILE
}  // namespace softbody::test
