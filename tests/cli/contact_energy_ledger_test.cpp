// The ledger of contact energy, on invented potentials and on worlds.

#include "app/reference/contact_energy_ledger.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "softbody/contact/keys.h"
#include "softbody/forces/gas.h"
#include "softbody/forces/springs.h"
#include "softbody/world/measures.h"

namespace app::test {
namespace {

using Pairs = std::vector<softbody::PairEnergy>;

TEST(ContactEnergyLedger, BooksAllThatPairsHoldAtTheStart) {
  reference::ContactEnergyLedger ledger;
  EXPECT_DOUBLE_EQ(ledger.add_bodies(Pairs{{{0, 5}, 2}, {{1, 5}, 0.5}}, 0), 2.5);
  EXPECT_DOUBLE_EQ(ledger.stored(), 2.5);
}

TEST(ContactEnergyLedger, DoesNotBookTheEnergyOfANewPair) {
  reference::ContactEnergyLedger ledger;
  ledger.end_frame({}, Pairs{{{0, 5}, 2}});
  EXPECT_EQ(ledger.stored(), 0);
}

TEST(ContactEnergyLedger, BooksWhatMotionStoresAndReturns) {
  reference::ContactEnergyLedger ledger;
  ledger.end_frame({}, Pairs{{{0, 5}, 2}, {{0, 6}, 1}});
  ledger.end_frame(Pairs{{{0, 5}, 2.5}, {{0, 6}, 1.25}}, Pairs{{{0, 5}, 2.5}, {{0, 6}, 1.25}});
  EXPECT_DOUBLE_EQ(ledger.stored(), 0.75);
  ledger.end_frame(Pairs{{{0, 5}, 2.25}, {{0, 6}, 1.25}}, Pairs{{{0, 5}, 2.25}, {{0, 6}, 1.25}});
  EXPECT_DOUBLE_EQ(ledger.stored(), 0.5);
}

TEST(ContactEnergyLedger, KeepsAPairAtZeroIfItGivesMoreThanItHolds) {
  reference::ContactEnergyLedger ledger;
  ledger.end_frame({}, Pairs{{{0, 5}, 2}, {{1, 6}, 0}});
  ledger.end_frame(Pairs{{{0, 5}, 0.5}, {{1, 6}, 0.25}}, Pairs{{{0, 5}, 0.5}, {{1, 6}, 0.25}});
  EXPECT_DOUBLE_EQ(ledger.stored(), 0.25) << "nor do other pairs pay for it";
}

/// As if stiffness were shared among more contacts, then among fewer again.
TEST(ContactEnergyLedger, IgnoresChangesOfPotentialBetweenFrames) {
  reference::ContactEnergyLedger ledger;
  ledger.add_bodies(Pairs{{{0, 5}, 1}}, 0);
  ledger.end_frame(Pairs{{{0, 5}, 1.5}}, Pairs{{{0, 5}, 3}});
  EXPECT_DOUBLE_EQ(ledger.stored(), 1.5);
  ledger.end_frame(Pairs{{{0, 5}, 3}}, Pairs{{{0, 5}, 0.5}});
  EXPECT_DOUBLE_EQ(ledger.stored(), 0.5) << "it can return no more";
  ledger.end_frame(Pairs{{{0, 5}, 0.5}}, Pairs{{{0, 5}, 3}});
  EXPECT_DOUBLE_EQ(ledger.stored(), 0.5);
}

TEST(ContactEnergyLedger, ForgetsPairsThatAreNoLongerFound) {
  reference::ContactEnergyLedger ledger;
  ledger.add_bodies(Pairs{{{0, 5}, 1}, {{2, 5}, 4}}, 0);
  ledger.end_frame(Pairs{{{0, 5}, 1}, {{2, 5}, 4}}, Pairs{{{2, 5}, 4}});
  EXPECT_DOUBLE_EQ(ledger.stored(), 4);
  ledger.end_frame(Pairs{{{2, 5}, 4}}, Pairs{{{0, 5}, 1}, {{2, 5}, 4}});
  EXPECT_DOUBLE_EQ(ledger.stored(), 4);
}

TEST(ContactEnergyLedger, BooksWhatPairsOfAddedBodiesHold) {
  reference::ContactEnergyLedger ledger;
  ledger.add_bodies(Pairs{{{0, 5}, 4}}, 0);
  EXPECT_DOUBLE_EQ(ledger.add_bodies(Pairs{{{0, 5}, 9}, {{1, 8}, 0.5}, {{9, 11}, 0.25}}, 8), 0.75)
      << "without other bodies' pairs";
  EXPECT_DOUBLE_EQ(ledger.stored(), 4.75);
  ledger.end_frame(Pairs{{{0, 5}, 4}}, Pairs{{{0, 5}, 4}, {{1, 8}, 2}, {{9, 11}, 0.125}});
  EXPECT_DOUBLE_EQ(ledger.stored(), 4.625) << "pairs that did not act in a first frame gain nothing";
}

TEST(ContactEnergyLedger, IgnoresWhatAFirstFrameMovesABodyInto) {
  reference::ContactEnergyLedger ledger;
  EXPECT_EQ(ledger.add_bodies({}, 8), 0);
  ledger.end_frame({}, Pairs{{{1, 9}, 1}});
  EXPECT_EQ(ledger.stored(), 0);
}

/// A slack ball hits one that is 1e6 times as stiff. Its particles slip between the other's and are found from behind.
softbody::Scene slack_on_stiff() {
  softbody::Scene scene;
  scene.gravity = glm::dvec3(0.0);
  scene.collision.self_collision = false;
  scene.sleep.speed = 0;
  for (const double k : {10.0, 1e-5}) {
    softbody::Material& m = scene.materials.emplace_back();
    m.name = k > 1 ? "stiff" : "slack";
    m.set(softbody::StructuralSprings::keys, {k, 0.1}), m.set(softbody::BendSprings::keys, {k / 4, 0.1});
    m[softbody::GasPressure::inside] = 1.6 * k;
    m[softbody::contact::rolling_resistance] = 0;
    softbody::BodySource& body = scene.bodies.emplace_back();
    body.material = int(scene.materials.size()) - 1;
    body.position = {0, k > 1 ? 0 : 1.7, 0};
    body.velocity = {0, k > 1 ? 0 : -1, 0};
  }
  return scene;
}

TEST(ContactEnergyLedger, IgnoresPairsFoundFromBehind) {
  softbody::World world(slack_on_stiff(), {.frame_time = 1.0 / 30});
  reference::ContactEnergyLedger ledger;
  ledger.add_bodies(world.pair_energies().next, 0);
  const double start = softbody::measure(world).energy, bound = 0.05 * 9.81;  // J: of m g R, both bodies
  double stored = 0, potential = 0;                                           // J, the most: with the bodies' own
  for (int frame = 0; frame < 60; ++frame) {
    world.step();
    ledger.end_frame(world.pair_energies().last, world.pair_energies().next);
    const double own = softbody::measure(world).energy - start;
    stored = std::max(stored, own + ledger.stored());
    potential = std::max(potential, own + softbody::total(world.pair_energies().next));
  }
  EXPECT_GT(potential, 2 * bound) << "they are found from behind";
  EXPECT_LT(stored, bound);
}

/// The bodies meet slowly, so that dampers take little; also while both drift, so that their origins move with them.
TEST(ContactEnergyLedger, HoldsTheEnergyThatBodiesLose) {
  for (const double drift : {0.0, 6.0}) {  // m/s
    softbody::Scene scene = slack_on_stiff();
    scene.bodies[1].material = 0;
    scene.bodies[1].position.y = 1.25;
    scene.bodies[0].velocity = {drift, 0, 0};
    scene.bodies[1].velocity = {drift, -0.2, 0};
    softbody::World world(scene, {.frame_time = 1.0 / 240});
    reference::ContactEnergyLedger ledger;
    ledger.add_bodies(world.pair_energies().next, 0);
    const double start = softbody::measure(world).energy, rounding = 1e-6 * (1 + drift * drift);  // J
    double most = 0, lost = 0;  // J: stored, and what the bodies had less then
    for (int frame = 0; frame < 480; ++frame) {
      world.step();
      const double before = ledger.stored();
      ledger.end_frame(world.pair_energies().last, world.pair_energies().next);
      const double own = softbody::measure(world).energy - start;
      ASSERT_LT(own + ledger.stored(), rounding) << drift << " m/s, frame " << frame;
      ASSERT_NEAR(ledger.stored(), before, 1e-4) << drift << " m/s, frame " << frame;
      if (ledger.stored() > most) most = ledger.stored(), lost = -own;
    }
    EXPECT_GT(most, 5e-4) << drift;
    EXPECT_GT(most, 0.8 * lost) << drift;
    EXPECT_EQ(ledger.stored(), 0) << "they have separated, " << drift;
  }
}

}  // namespace
}  // namespace app::test
