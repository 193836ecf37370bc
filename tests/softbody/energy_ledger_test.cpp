// The ledger of energy, audited: worlds run at much smaller steps than they need, their energy is summed here from
// positions and velocities, and what was booked has to account for it. Without the bookings of one account it must not.

#include "softbody/state/energy_ledger.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <string>

#include "softbody/mechanics/deformation.h"
#include "softbody/mechanics/make_body_model.h"
#include "softbody/state/state.h"
#include "softbody/world/energy_watch.h"
#include "softbody/world/snapshot.h"
#include "tests/softbody/surface_rig.h"
#include "tests/support/change.h"
#include "tests/support/world_test_access.h"

namespace softbody::test {
namespace THIS_FILE {

/// The energies (J) of a world, by plain loops.
struct Sums {
  double energy = 0;  // that the ledger is about
  double active = 0, mass = 0;

  explicit Sums(const World& world) {
    const double staggering = ledger(world).staggering;
    for (BodyId id = 0; id < world.bodies().count(); ++id) {
      const BodyModel& model = world.model(id);
      std::vector<glm::dvec3> x, before, after;
      double kinetic = 0, height = 0, fall = 0;
      constexpr double moment = 1e-6;  // s
      for (const Particle& q : particles_of(world, id)) {
        x.push_back(q.position);
        before.push_back(q.position - moment * q.velocity);
        after.push_back(q.position + moment * q.velocity);
        kinetic += model.particle_mass / 2 * glm::dot(q.velocity, q.velocity);
        height -= model.particle_mass * glm::dot(world.scene().gravity, q.position);
        fall += model.particle_mass * glm::dot(world.scene().gravity, q.velocity);
      }
      const auto springs_and_gas = [&](const std::vector<glm::dvec3>& at) { return stored_energy(model, at).total(); };
      const double power = fall + (springs_and_gas(before) - springs_and_gas(after)) / (2 * moment);
      const StoredEnergy now = stored_energy(model, x), start = stored_energy(model, model.start);
      energy += kinetic + height + now.elastic + now.gas + staggering / 2 * power;
      active += kinetic + std::abs(now.elastic - start.elastic) + std::abs(now.gas - start.gas);
      mass += model.material[Material::mass];
    }
  }
};

Material material() {
  Material m = gas_ball();
  m[StructuralSprings::damping_ratio] = m[BendSprings::damping_ratio] = 0;
  m[Material::thickness] = 0.005;
  m[contact::friction] = 0;
  return m;
}

/// Returns the radius of the ball in m.
double radius() { return glm::length(make_body_model({}, material())->start[0]); }

Scene ball(const glm::dvec3& gravity = glm::dvec3(0.0)) {
  Scene scene = lone_body(material());
  scene.gravity = gravity;
  return scene;
}

Scene by_surfaces(Scene scene) {
  scene.contact_surface = ContactSurface::surfaces;
  return scene;
}

/// Returns two balls whose centres are so many radii apart.
Scene pair(double apart) {
  Scene scene = ball();
  add_body(scene, {apart * radius(), 0.05, 0.02}, glm::dvec3(0.0));
  return scene;
}

constexpr glm::dvec3 down{0, -9.81, 0};

/// A case in which one account does most of the work.
struct Case {
  const char* name;
  WorkBy by;
  std::function<Scene()> scene;
  std::function<void(World&)> act = [](World&) {};  // before each frame
  double lost = 1;                                  // share of the work that may be lost
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

void once(World& world, int frame, const std::function<void()>& change) {
  if (world.frame() == frame) change();
}

const Case cases[]{
    {"ASolidIsMovedOntoABall", WorkBy::solids, [] { return ball(); },
     [](World& w) {
       Scene with = w.scene();
       set_solid(with, {Ground{0.03 - radius()}, 0});
       once(w, 3, [&] { w.apply(with); });
     },
     0.5},
    {"ASphereIsMovedOntoAFace", WorkBy::solids, [] { return by_surfaces(ball()); },
     [](World& w) {
       Scene with = w.scene();
       set_solid(with, {.shape = SolidSphere{.centre = {0.05, -0.07 - radius(), 0.03}, .radius = 0.1}, .friction = 0});
       once(w, 3, [&] { w.apply(with); });
     },
     0.5},
    {"ABallStartsInASolid", WorkBy::easing,
     [] {
       Scene s = ball(down);
       set_solid(s, {SolidSphere{.centre = {-0.3, -0.2, 0}}});
       return s;
     },
     [](World&) {}, 0.1},
    {"BallsOverlap", WorkBy::surfaces, [] { return by_surfaces(pair(1.9)); }, [](World&) {}, 0.3},
    {"BallsStartInEachOther", WorkBy::surfaces, [] { return by_surfaces(pair(0.6)); }, [](World&) {}, 0.1},
    {"VerticesRepelEachOther", WorkBy::penalty,
     [] {
       Scene s = pair(1.8);
       s.collision.tolerance = 0.2f;
       return s;
     },
     [](World&) {}, 1},
    {"AHandLifts", WorkBy::hand, [] { return ball(down); },
     [](World& w) {
       w.grab(Grab{.corners = w.model(0).mesh.triangles[0], .weights = glm::dvec3(1.0 / 3), .target = {0, 3, 0}});
     },
     0.1},
    {"GasIsLetOut", WorkBy::user, [] { return ball(); },
     [](World& w) { once(w, 3, [&] { change(w, [](Scene& s) { s.materials[0][GasPressure::inside] *= 0.98; }); }); },
     0.1},
    {"ABodyIsThrownAndAnotherRemoved", WorkBy::user, [] { return pair(6); },
     [](World& w) {
       BodySource fast = w.scene().bodies[0];
       fast.position = {9, 0, 0}, fast.velocity = {5, 0, 0};
       once(w, 3, [&] { w.add(fast); });
       once(w, 6, [&] { w.remove(0); });
     },
     0.1},
    {"ParticlesAreMoved", WorkBy::user, [] { return ball(down); },
     [](World& w) { once(w, 3, [&] {
                      place(w, {1.05, 1, 0.97}, 3);
                    }); }, 0.1},
    {"GravityTurns", WorkBy::user, [] { return ball(down); },
     [](World& w) { once(w, 30, [&] { change(w, [](Scene& s) {
                                        s.gravity = {20, 0, 0};
                                      }); }); }, 0.1},
};

/// What the frames of a world come to.
struct Audited {
  double grown = 0, work = 0;  // J, of the energy, and booked
  bool needed = false;         // without the bookings of one account, some frame would have gained energy from nowhere
};

/// Runs a world. No frame may gain energy from nowhere.
Audited audit(World& world, WorkBy account, const std::function<void(World&)>& act) {
  Audited all;
  Sums before(world);
  EnergyLedger booked = ledger(world);
  for (int i = 0; i < 60; ++i) {
    act(world);
    world.step();
    const Sums now(world);
    const double grown = now.energy - before.energy, work = ledger(world).total() - booked.total();
    const double own = ledger(world).booked(account) - booked.booked(account);
    const double active = std::max(now.active, before.active), rounding = now.mass / 2 * 1e-6;
    EXPECT_FALSE(from_nowhere(grown - work, active, rounding))
        << "frame " << world.frame() << ": grown by " << grown << " J of " << active << " J, booked " << work << " J";
    all.needed = all.needed || from_nowhere(grown - work + own, active, rounding);
    all.grown += grown, all.work += work;
    before = now;
    booked = ledger(world);
  }
  return all;
}

constexpr double short_frame = 1.0 / 240;  // s

class Audit : public testing::TestWithParam<std::tuple<Case, const char*>> {};

TEST_P(Audit, FindsThatTheBookingsAccountForTheEnergyAndAreNeeded) {
  const Case& c = std::get<0>(GetParam());
  const std::string method = std::get<1>(GetParam());
  World world(c.scene(), {.frame_time = short_frame, .integrator = {method, method == "implicit" ? 8 : 40}});
  const Audited all = audit(world, c.by, c.act);
  EXPECT_TRUE(all.needed);
  if (method != "velocity-verlet" && method != "semi-implicit-euler") return;  // others lose energy by themselves
  EXPECT_LT(all.grown, all.work + 0.05 * std::abs(all.work));
  EXPECT_GT(all.grown, all.work - c.lost * std::abs(all.work));
}

INSTANTIATE_TEST_SUITE_P(All, Audit,
                         testing::Combine(testing::ValuesIn(cases),
                                          testing::Values("semi-implicit-euler", "velocity-verlet", "rk4", "implicit")),
                         [](const auto& one) {
                           std::string name = std::string(std::get<0>(one.param).name) + "By_" + std::get<1>(one.param);
                           std::erase(name, '-');
                           return name;
                         });

/// A ball that breathes, in steps of two lengths by turns.
TEST(EnergyLedger, BooksWhatStepsGiveThatBecomeLonger) {
  World world(ball(), {.frame_time = short_frame, .integrator = {"semi-implicit-euler", 40}});
  place(world, {1.02, 1.02, 1.02});
  const Audited all = audit(world, WorkBy::steps, [](World& w) {
    w.set_integrator({"semi-implicit-euler", w.frame() % 2 ? 40 : 8});
  });
  EXPECT_TRUE(all.needed);
}

/// Steps are ten times too long, or dampers drive.
TEST(EnergyWatch, FindsBlowUpsWithinTenFramesInEveryScene) {
  constexpr Index many = 20'000;  // vertices: they would take minutes
  for (const std::string& key : scene_keys(SBCOLLIDE_SCENES)) {
    World world(find_scene(key, SBCOLLIDE_SCENES),
                {.integrator = {"semi-implicit-euler"}, .budget = {.least = 1e7}});  // it cuts frames that blow up
    if (world.bodies().vertex_count() > many) continue;
    EnergyWatch watch;
    const auto found = [&] {
      world.step();
      const std::vector<BodyMeasures> bodies = measure_bodies(world);
      if (!std::ranges::all_of(bodies, &BodyMeasures::finite)) return true;
      const std::optional<EnergyChange> change = watch.look(world, bodies);
      return change && change->from_nowhere();
    };
    while (world.frame() < 40 || measure(world).max_speed == 0)
      ASSERT_FALSE(found()) << key << ", frame " << world.frame();
    const Snapshot sound = world.snapshot();
    for (const bool too_long : {true, false}) {
      world.restore(sound);
      watch.look(world, measure_bodies(world));
      if (too_long) world.set_integrator({"semi-implicit-euler", std::max(1, world.last_step().needed / 10)});
      for (std::size_t i = 0; !too_long && i < world.scene().materials.size(); ++i) {
        Material m = world.scene().materials[i];
        m[StructuralSprings::damping_ratio] = m[BendSprings::damping_ratio] = -3;
        WorldTestAccess::set_material(world, i, m);
      }
      int frames = 1;
      while (frames <= 10 && !found()) ++frames;
      EXPECT_LE(frames, 10) << key << (too_long ? ", too long" : ", driven");
    }
  }
}

TEST(EnergyWatch, DoesNotJudgeAcrossASwitchOfIntegrators) {
  World world(ball(), {.integrator = {"xpbd"}});
  EnergyWatch watch;
  const auto next = [&] {
    world.step();
    return watch.look(world, measure_bodies(world));
  };
  EXPECT_FALSE(next()) << "there is nothing before the first look";
  EXPECT_FALSE(next()->conserved) << "XPBD loses energy";
  world.set_integrator({"semi-implicit-euler"});
  EXPECT_FALSE(next()->conserved) << "one end of the change is XPBD's";
  EXPECT_TRUE(next()->conserved);
}

/// Contacts turn the held corner away from where the hand's force alone would take it.
TEST(EnergyWatch, FindsNothingWhereAHandTearsABallThroughItself) {
  Material soft = rubber();
  soft[GasPressure::inside] = soft[GasPressure::outside];
  Scene scene = ball_in_space(soft);
  scene.bodies[0].mesh.subdivisions = 3;
  for (const char* integrator : {"auto", "velocity-verlet", "rk4"}) {
    World world(scene, {.integrator = {integrator}});
    EnergyWatch watch;
    Grab grab{.weights = {1, 0, 0}};
    while (world.frame() < 25) {
      const double way = 0.15 * world.frame();
      grab.target = 3.0 * glm::dvec3(std::sin(way), std::sin(2 * way), std::cos(3 * way));
      world.grab(grab);
      world.step();
      const std::optional<EnergyChange> change = watch.look(world, measure_bodies(world));
      ASSERT_FALSE(change && change->from_nowhere())
          << integrator << ", " << frame_of(world) << ": " << change->gain << " J";
    }
  }
}

}  // namespace THIS_FILE
}  // namespace softbody::test
