// The loops over vertices against plain scalar code, with the instructions of every target that this machine has.

#include "collide/vertex_kernels.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <limits>

#include "collide/reach.h"
#include "states.h"

namespace collide::test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr std::array<Index, 12> sizes{1, 2, 3, 4, 5, 7, 8, 15, 16, 17, 64, 101};
constexpr std::size_t no_limit = std::size_t{1} << 20;

struct Points3 {
  std::vector<float> x, y, z;
  explicit Points3(const std::vector<glm::vec3>& points) {
    for (const glm::vec3& p : points) x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
  }
  Run run() const { return {x.data(), y.data(), z.data(), static_cast<Index>(x.size())}; }
};

Picked picked(const Points3& points, Index first) {
  Picked set;
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

long double distance(const Run& a, Index i, const Run& b, Index j) {
  const long double dx = static_cast<long double>(a.x[i]) - static_cast<long double>(b.x[j]),
                    dy = static_cast<long double>(a.y[i]) - static_cast<long double>(b.y[j]),
                    dz = static_cast<long double>(a.z[i]) - static_cast<long double>(b.z[j]);
  return std::sqrt(dx * dx + dy * dy + dz * dz);
}

class Kernels : public testing::TestWithParam<std::int64_t> {
 protected:
  void SetUp() override { hwy::SetSupportedTargetsForTest(GetParam()); }
  void TearDown() override { hwy::SetSupportedTargetsForTest(0); }
  std::mt19937 random_{41};
  Words words_;
  std::vector<Contact> contacts_;
};

TEST_P(Kernels, BoundHoldsEveryVertexAndIsTight) {
  for (const Index size : sizes) {
    for (const float scale : {1e-42f, 1e-21f, 1.0f, 1e15f, 1e38f}) {
      const Points3 points(random_points(random_, size, -scale, 2 * scale));
      const Bound bound = bound_of(points.run());
      ASSERT_TRUE(bound.finite);
      glm::vec3 lo(infinity), hi(-infinity);
      long double farthest = 0;
      const Points3 centre({bound.centre});
      for (Index v = 0; v < size; ++v) {
        const glm::vec3 p(points.x[v], points.y[v], points.z[v]);
        for (int axis = 0; axis < 3; ++axis)
          lo[axis] = std::min(lo[axis], p[axis]), hi[axis] = std::max(hi[axis], p[axis]);
        farthest = std::max(farthest, distance(points.run(), v, centre.run(), 0));
      }
      EXPECT_EQ(bound.box.lo, lo);
      EXPECT_EQ(bound.box.hi, hi);
      EXPECT_GE(static_cast<long double>(bound.radius), farthest);
      EXPECT_EQ(bound.largest, std::max({-lo.x, -lo.y, -lo.z, hi.x, hi.y, hi.z}));
      if (scale > 1e-15f && scale < 1e18f) {
        EXPECT_LE(static_cast<long double>(bound.radius), farthest * 1.000001L + 1e-22L);
      }
    }
  }
}

TEST_P(Kernels, BoundKnowsWhatIsNotFinite) {
  for (const Index size : sizes) {
    for (Index v = 0; v < size; ++v) {
      for (const float bad : {nan, infinity, -infinity}) {
        Points3 points(random_points(random_, size, -1, 1));
        (v % 3 == 0 ? points.x : v % 3 == 1 ? points.y : points.z)[v] = bad;
        EXPECT_FALSE(bound_of(points.run()).finite) << size << ' ' << v;
      }
    }
  }
}

TEST_P(Kernels, ContactsAreThoseOfPlainLoops) {
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
      contacts_of(picked(set, 0), i, 0.25f, words_, contacts_);
      EXPECT_EQ(contacts_, of_one);
    }
  }
}

TEST_P(Kernels, ContactsOfNothingAreNone) {
  const Points3 some(random_points(random_, 20, 0, 1));
  Picked nothing;
  nothing.reserve(0);
  nothing.end();
  contacts_between(picked(some, 0), nothing, 9, no_limit, words_, contacts_);
  contacts_between(nothing, picked(some, 0), 9, no_limit, words_, contacts_);
  contacts_within(nothing, 9, no_limit, words_, contacts_);
  EXPECT_TRUE(contacts_.empty());
}

TEST_P(Kernels, ContactsStopAtTheMost) {
  const Picked crowd = picked(Points3(std::vector<glm::vec3>(30, glm::vec3(0))), 0);
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
TEST_P(Kernels, FaceFindsAllContactsOfTheVerticesThatItPicks) {
  FacingScratch scratch;
  int parted = 0, some = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const Index size_a = sizes[random_() % sizes.size()], size_b = sizes[random_() % sizes.size()];
    glm::vec3 normal = random_points(random_, 1, -1, 1)[0];
    normal *= 1 / std::sqrt(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z);
    const Points3 a(random_points(random_, size_a, -0.5f, 0.5f));
    const Points3 b(moved(random_points(random_, size_b, -0.5f, 0.5f), normal * uniform(random_, 0.2f, 1.8f)));
    const float tolerance = 0.3f;
    const Slab slab{normal, contact_reach(tolerance) + 1e-5f};
    const auto along = [&](const Points3& p, Index v) {
      return normal.x * p.x[v] + normal.y * p.y[v] + normal.z * p.z[v];
    };
    float front = -infinity, back = infinity;
    for (Index v = 0; v < size_a; ++v) front = std::max(front, along(a, v));
    for (Index v = 0; v < size_b; ++v) back = std::min(back, along(b, v));
    std::vector<Index> facing_a, facing_b;
    for (Index v = 0; v < size_a; ++v) {
      if (along(a, v) >= back - slab.reach) facing_a.push_back(70 + v);
    }
    for (Index v = 0; v < size_b; ++v) {
      if (along(b, v) <= front + slab.reach) facing_b.push_back(900 + v);
    }
    const std::vector<Contact> expected = all_between(a, 70, b, 900, tolerance * tolerance);
    contacts_.clear();
    const Facing all = face(a.run(), 70, b.run(), 900, slab, tolerance * tolerance, 16384, scratch, contacts_);
    ASSERT_TRUE(all.done);
    ASSERT_EQ(contacts_, expected);
    ASSERT_EQ(all.tests, facing_b.empty() ? 0 : facing_a.size() * facing_b.size());
    (all.tests == 0 ? parted : some) += 1;
    if (all.tests == 0) continue;
    contacts_.clear();
    const Facing too_many =
        face(a.run(), 70, b.run(), 900, slab, tolerance * tolerance, all.tests - 1, scratch, contacts_);
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

/// Whatever the map, its residuals are what the comment says; and an affine image of the reference has hardly any.
TEST_P(Kernels, ResidualsAreThoseOfTheMap) {
  for (const Index size : {16u, 17u, 31u, 42u, 127u, 128u, 162u, 333u}) {
    std::vector<glm::vec3> points = random_points(random_, size, -1, 1);
    glm::dvec3 mean(0);
    double samples = 0;
    for_samples(size, [&](Index v) { mean += glm::dvec3(points[v]), samples += 1; });
    for (glm::vec3& p : points) p -= glm::vec3(mean / samples);
    // The inverse of the moment by Cramer's rule.
    std::array<double, 6> m{};
    for_samples(size, [&](Index v) {
      const glm::dvec3 p(points[v]);
      m[0] += p.x * p.x, m[1] += p.x * p.y, m[2] += p.x * p.z, m[3] += p.y * p.y, m[4] += p.y * p.z, m[5] += p.z * p.z;
    });
    const double a = m[3] * m[5] - m[4] * m[4], b = m[2] * m[4] - m[1] * m[5], c = m[1] * m[4] - m[2] * m[3];
    const double d = m[0] * m[5] - m[2] * m[2], e = m[1] * m[2] - m[0] * m[4], f = m[0] * m[3] - m[1] * m[1];
    const double det = m[0] * a + m[1] * b + m[2] * c;
    const std::array adjoint{a, b, c, b, d, e, c, e, f};
    std::array<float, 9> inverse;
    std::transform(adjoint.begin(), adjoint.end(), inverse.begin(),
                   [&](double value) { return static_cast<float>(value / det); });
    const Points3 reference(points);
    const glm::vec3 centre(3, -2, 1);
    for (const float noise : {0.0f, 0.2f}) {
      std::vector<glm::vec3> image = random_points(random_, size, -noise, noise);
      for (Index v = 0; v < size; ++v) {
        const glm::vec3& p = points[v];
        image[v] += centre + glm::vec3(0.5f * p.x + 0.3f * p.y + 0.1f, -0.7f * p.y + p.z, 0.2f * p.x + p.z - 0.3f);
      }
      const Points3 body(image);
      std::vector<float> residual2(size);
      const AffineFit fit = fit_affine(body.run(), reference.run(), inverse, centre, residual2);
      float greatest = 0;
      for (Index v = 0; v < size; ++v) {
        const auto error = [&](std::size_t row, float at, float middle) {
          const float* const r = &fit.matrix[3 * row];
          const float mapped = r[0] * reference.x[v] + r[1] * reference.y[v] + r[2] * reference.z[v];
          return at - middle - fit.offset[row] - mapped;
        };
        const float x = error(0, body.x[v], centre.x), y = error(1, body.y[v], centre.y),
                    z = error(2, body.z[v], centre.z);
        ASSERT_EQ(residual2[v], x * x + y * y + z * z);
        greatest = std::max(greatest, residual2[v]);
      }
      EXPECT_EQ(fit.residual, std::sqrt(greatest));
      if (noise == 0) {
        EXPECT_LT(fit.residual, 1e-5f) << size;
        EXPECT_NEAR(fit.matrix[4], -0.7, 1e-4);
      }
    }
  }
}

TEST_P(Kernels, MovesAreBoundsOfTheFarthest) {
  for (const Index size : sizes) {
    const Points3 before(random_points(random_, size, -1, 1));
    EXPECT_EQ(farthest_move(before.run(), before.run()), 0.0f);
    for (Index v = 0; v < size; ++v) {
      for (const float by : {1e-7f, 1e-3f, 2.0f, 1e18f}) {
        Points3 now = before;
        (v % 3 == 0 ? now.x : v % 3 == 1 ? now.y : now.z)[v] += by;
        const long double moved = distance(now.run(), v, before.run(), v);
        const auto bound = static_cast<long double>(farthest_move(now.run(), before.run()));
        EXPECT_GE(bound, moved);
        EXPECT_LE(bound, moved * 1.000001L);
      }
      Points3 now = before;
      now.y[v] = std::nextafter(now.y[v], 2.0f);
      EXPECT_GT(farthest_move(now.run(), before.run()), 0.0f);
      for (const float bad : {nan, infinity, -3e38f}) {
        now.z[v] = bad;
        EXPECT_EQ(farthest_move(now.run(), before.run()), infinity);
        EXPECT_EQ(farthest_move(before.run(), now.run()), infinity);
      }
      EXPECT_EQ(farthest_move(now.run(), now.run()), 0.0f) << "at -3e38, and still there";
    }
  }
  const Points3 zero({glm::vec3(0)}), minus_zero({glm::vec3(-0.0f)}), least({glm::vec3(0, 1e-45f, 0)});
  EXPECT_EQ(farthest_move(zero.run(), minus_zero.run()), 0.0f);
  EXPECT_GE(farthest_move(least.run(), zero.run()), 1e-45f) << "though its square vanishes";
}

TEST_P(Kernels, StripsAreSweptToTheEndOfReach) {
  for (const Index size : sizes) {
    for (int along = 0; along < 3; ++along) {
      StripBoxes boxes;
      boxes.along = along;
      boxes.resize(size);
      std::vector<Aabb> all;
      for (const glm::vec3& lo : random_points(random_, size, 0, 3)) {
        all.push_back({lo, lo + random_points(random_, 1, 0.1f, 1)[0]});
      }
      std::sort(all.begin(), all.end(), [&](const Aabb& a, const Aabb& b) { return a.lo[along] < b.lo[along]; });
      const auto centre = [&](Index i) { return all[i].lo * 0.5f + all[i].hi * 0.5f; };
      const auto radius = [&](Index i) { return 0.4f * (all[i].hi.x - all[i].lo.x); };
      for (Index i = 0; i < size; ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          boxes.lo[axis][i] = all[i].lo[static_cast<int>(axis)];
          boxes.hi[axis][i] = all[i].hi[static_cast<int>(axis)];
          boxes.centre[axis][i] = centre(i)[static_cast<int>(axis)];
        }
        boxes.radius[i] = radius(i);
      }
      const float reach = 0.2f;
      for (Index i = 0; i < size; ++i) {
        const Index begin = random_() % (size + 1), end = begin + random_() % (size + 1 - begin);
        std::vector<Index> expected, found{77};
        Index near_boxes = 0;
        for (Index j = begin; j < end; ++j) {
          if (!near(all[i], all[j], reach)) continue;
          ++near_boxes;
          const glm::vec3 d = centre(j) - centre(i);
          const float reached = radius(i) + radius(j) + reach;
          if (d.x * d.x + d.y * d.y + d.z * d.z <= reached * reached * 1.000003f) expected.push_back(j);
        }
        expected.insert(expected.begin(), 77);
        EXPECT_EQ(sweep_strip(boxes, i, begin, end, reach, found), near_boxes);
        EXPECT_EQ(found, expected);
      }
    }
  }
}

/// The whole detector, over a few frames of which the last ones are remembered.
TEST_P(Kernels, FindTheSameContactsOnEveryTarget) {
  for (const NamedState& named : named_states()) {
    State state = named.make();
    Settings settings;
    settings.tolerance = state.tolerance;
    const std::vector<Contact> expected = oracle(state, settings);
    const auto detector = find_method("multi-level-sb-exact")->make();
    Workers workers(2);
    Result result;
    for (int frame = 0; frame < 5; ++frame) {
      detector->detect(state.frame(), settings, workers, result);
      ASSERT_EQ(result.contacts, expected) << named.name << ' ' << frame;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, Kernels, testing::ValuesIn([] {
                           std::vector<std::int64_t> targets;
                           for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
                             targets.push_back(left & -left);
                           }
                           return targets;
                         }()),
                         [](const auto& target) { return std::string(hwy::TargetName(target.param)); });

}  // namespace
}  // namespace collide::test
