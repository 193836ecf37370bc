// The loops over pairs of vertices against plain scalar code, on every target.

#include "collide/exact/pair_kernels.h"

#include <algorithm>
#include <stdexcept>

#include "collide/core/cutoff.h"
#include "every_target.h"

namespace collide::test {

using namespace collide::exact;
namespace THIS_FILE {

constexpr std::size_t no_limit = std::size_t{1} << 20;

VertexSet picked(const Points3& points, Index first) {
  VertexSet set;
  set.take(points.run(), first);
  return set;
}

float squared(const Points3& a, Index i, const Points3& b, Index j) {
  return squared_distance(a.x[i], a.y[i], a.z[i], b.x[j], b.y[j], b.z[j]);
}

std::vector<Contact> all_between(const Points3& a, Index first_a, const Points3& b, Index first_b, float tolerance2) {
  std::vector<Contact> contacts;
  for (Index i = 0; i < a.x.size(); ++i) {
    for (Index j = 0; j < b.x.size(); ++j) {
      if (squared(a, i, b, j) < tolerance2) contacts.push_back({first_a + i, first_b + j});
    }
  }
  return contacts;
}

class PairKernels : public OnEveryTarget {
 protected:
  Words words_;
  std::vector<Contact> contacts_;
};

TEST_P(PairKernels, ContactsAreThoseOfPlainLoops) {
  for (const Index size_a : sizes) {
    for (const Index size_b : sizes) {
      const Points3 a(random_points(random_, size_a, 0, 1)), b(random_points(random_, size_b, 0, 1));
      contacts_.clear();
      contacts_between(picked(a, 10), picked(b, 500), 0.25f, no_limit, words_, contacts_);
      EXPECT_EQ(contacts_, all_between(a, 10, b, 500, 0.25f));
    }
    const Points3 set(random_points(random_, size_a, 0, 1));
    std::vector<Contact> within;
    for (const Contact& pair : all_between(set, 0, set, 0, 0.25f)) {
      if (pair.a < pair.b) within.push_back(pair);
    }
    contacts_.clear();
    contacts_within(picked(set, 0), 0.25f, no_limit, words_, contacts_);
    EXPECT_EQ(contacts_, within);
    for (Index i = 0; i < size_a; ++i) {
      std::vector<Contact> of_one;
      for (const Contact& pair : all_between(set, 0, set, 0, 0.25f)) {
        if (pair.a == i && pair.b != i) of_one.push_back(pair);
      }
      contacts_.clear();
      contacts_of(set.run(), 0, i, 0.25f, words_, contacts_);
      EXPECT_EQ(contacts_, of_one);
    }
  }
}

TEST_P(PairKernels, ContactsOfNothingAreNone) {
  const Points3 some(random_points(random_, 20, 0, 1));
  VertexSet nothing;
  nothing.reserve(0);
  nothing.end();
  contacts_between(picked(some, 0), nothing, 9, no_limit, words_, contacts_);
  contacts_between(nothing, picked(some, 0), 9, no_limit, words_, contacts_);
  contacts_within(nothing, 9, no_limit, words_, contacts_);
  EXPECT_TRUE(contacts_.empty());
}

TEST_P(PairKernels, ContactsStopAtTheMost) {
  const VertexSet crowd = picked(Points3(std::vector<glm::vec3>(30, glm::vec3(0))), 0);
  contacts_between(crowd, crowd, 1, 900, words_, contacts_);
  EXPECT_EQ(contacts_.size(), 900u);
  contacts_.clear();
  EXPECT_THROW(contacts_between(crowd, crowd, 1, 899, words_, contacts_), std::length_error);
  contacts_.clear();
  contacts_within(crowd, 1, 435, words_, contacts_);
  EXPECT_EQ(contacts_.size(), 435u);
  contacts_.clear();
  EXPECT_THROW(contacts_within(crowd, 1, 434, words_, contacts_), std::length_error);
}

/// Face to face along many directions: all contacts, in order; and the picked vertices are those that the slab leaves.
TEST_P(PairKernels, FaceFindsAllContactsOfTheVerticesThatItPicks) {
  FacingScratch scratch;
  int parted = 0, some = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const Index size_a = sizes[random_() % sizes.size()], size_b = sizes[random_() % sizes.size()];
    glm::vec3 normal = random_points(random_, 1, -1, 1)[0];
    normal *= 1 / std::sqrt(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z);
    const Points3 a(random_points(random_, size_a, -0.5f, 0.5f));
    const Points3 b(moved(random_points(random_, size_b, -0.5f, 0.5f), normal * uniform(random_, 0.2f, 1.8f)));
    const float tolerance = 0.3f;
    const Slab slab{normal, contact_cutoff(tolerance) + 1e-5f};
    const auto along = [&](const Points3& p, Index v) {
      return normal.x * p.x[v] + normal.y * p.y[v] + normal.z * p.z[v];
    };
    float front = -infinity, back = infinity;
    for (Index v = 0; v < size_a; ++v) front = std::max(front, along(a, v));
    for (Index v = 0; v < size_b; ++v) back = std::min(back, along(b, v));
    std::vector<Index> facing_a, facing_b;
    for (Index v = 0; v < size_a; ++v) {
      if (along(a, v) >= back - slab.cutoff) facing_a.push_back(70 + v);
    }
    for (Index v = 0; v < size_b; ++v) {
      if (along(b, v) <= front + slab.cutoff) facing_b.push_back(900 + v);
    }
    const std::vector<Contact> expected = all_between(a, 70, b, 900, tolerance * tolerance);
    contacts_.clear();
    const FacingResult all =
        find_facing_contacts(a.run(), 70, b.run(), 900, slab, tolerance * tolerance, 16384, scratch, contacts_);
    ASSERT_TRUE(all.done);
    ASSERT_EQ(contacts_, expected);
    ASSERT_EQ(all.tests, facing_b.empty() ? 0 : facing_a.size() * facing_b.size());
    (all.tests == 0 ? parted : some) += 1;
    if (all.tests == 0) continue;
    contacts_.clear();
    const FacingResult too_many =
        find_facing_contacts(a.run(), 70, b.run(), 900, slab, tolerance * tolerance, all.tests - 1, scratch, contacts_);
    ASSERT_FALSE(too_many.done);
    ASSERT_TRUE(contacts_.empty());
    ASSERT_EQ(std::vector<Index>(scratch.near_a.vertex.begin(), scratch.near_a.vertex.begin() + scratch.near_a.size),
              facing_a);
    ASSERT_EQ(std::vector<Index>(scratch.near_b.vertex.begin(), scratch.near_b.vertex.begin() + scratch.near_b.size),
              facing_b);
    contacts_between(scratch.near_a, scratch.near_b, tolerance * tolerance, no_limit, words_, contacts_);
    ASSERT_EQ(contacts_, expected);
  }
  EXPECT_GT(parted, 100);
  EXPECT_GT(some, 100);
}

/// The whole detector, over a few frames of which the last ones are remembered.
TEST_P(PairKernels, FindTheSameContactsOnEveryTarget) {
  for (const NamedState& named : named_states()) {
    State state = named.make();
    Settings settings;
    settings.tolerance = state.tolerance;
    const std::vector<Contact> expected = oracle(state, settings);
    const auto detector = find_method("multi-level-sb-exact")->make();
    Workers workers(2, 0);
    Result result;
    for (int frame = 0; frame < 5; ++frame) {
      detector->detect(state.frame(), settings, workers, result);
      ASSERT_EQ(result.contacts, expected) << named.name << ' ' << frame;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, PairKernels, testing::ValuesIn(targets()), target_name);

}  // namespace THIS_FILE
}  // namespace collide::test
