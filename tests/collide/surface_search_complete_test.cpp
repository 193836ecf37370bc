// The candidates of surface contact: nothing that comes within reach is missing, whatever moves how.

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "moving_surfaces.h"

namespace collide::test {

using namespace collide::surface;
namespace {

/// The candidates of two bodies as a table: when they begin, infinity if they are none.
class Candidates {
 public:
  Candidates(const SurfaceSearch& search, Index a, Index b, const Surface& sa, const Surface& sb)
      : faces_(sb.triangles().size()), faces_a_(sa.triangles().size()), edges_(sb.edges().size()) {
    vertex_face_.assign(sa.vertex_count() * faces_, none);
    face_vertex_.assign(sb.vertex_count() * faces_a_, none);
    edge_edge_.assign(sa.edges().size() * edges_, none);
    for (const SurfacePair& p : search.pairs()) {
      if (p.a != a || p.b != b) continue;
      const auto& list = search.features();
      for (std::uint32_t i = p.vertex_face; i < p.face_vertex; ++i)
        vertex_face_[list[i].a * faces_ + list[i].b] = list[i].from;
      for (std::uint32_t i = p.face_vertex; i < p.edge_edge; ++i)
        face_vertex_[list[i].a * faces_a_ + list[i].b] = list[i].from;
      for (std::uint32_t i = p.edge_edge; i < p.end; ++i) edge_edge_[list[i].a * edges_ + list[i].b] = list[i].from;
    }
  }
  float vertex_face(Index vertex, Index face) const { return vertex_face_[vertex * faces_ + face]; }
  float face_vertex(Index vertex, Index face) const { return face_vertex_[vertex * faces_a_ + face]; }
  float edge_edge(Index one, Index two) const { return edge_edge_[one * edges_ + two]; }

 private:
  static constexpr float none = std::numeric_limits<float>::infinity();
  std::size_t faces_, faces_a_, edges_;
  std::vector<float> vertex_face_, face_vertex_, edge_edge_;
};

/// A moment at which pairs of features are looked at, by plain loops.
struct Moment {
  const Moving& moving;
  const Scene& scene;
  float time;
  std::size_t within = 0;  // pairs that were within reach

  glm::vec3 at(Index body, Index v) const { return scene.at(moving.first(body) + v); }
  template <std::size_t n>
  Aabb box(Index body, const std::array<Index, n>& corners, float grown) const {
    Aabb all{at(body, corners[0]), at(body, corners[0])};
    for (const Index v : corners) all = {glm::min(all.lo, at(body, v)), glm::max(all.hi, at(body, v))};
    return {all.lo - grown, all.hi + grown};
  }
  template <std::size_t n, std::size_t m>
  static bool share(const std::array<Index, n>& a, const std::array<Index, m>& b) {
    return std::any_of(a.begin(), a.end(), [&](Index v) { return std::find(b.begin(), b.end(), v) != b.end(); });
  }
  float reach(Index body) const { return moving.traits[body].skin - moving.traits[body].slack; }

  /// from(i, j): when the candidate of feature i and j begins. closest(i, j): of the two.
  template <class Ones, class Twos, class From, class Of>
  void expect(Index a, const Ones& ones, Index b, const Twos& twos, const From& from, const Of& closest, bool ordered) {
    const float distance = reach(a) + reach(b);
    std::vector<Aabb> boxes;
    for (const auto& two : twos) boxes.push_back(box(b, two, 0));
    for (Index i = 0; i < ones.size(); ++i) {
      const Aabb near_one = box(a, ones[i], distance);
      for (Index j = ordered ? i + 1 : 0; j < twos.size(); ++j) {
        if (!near(near_one, boxes[j], 0) || (a == b && share(ones[i], twos[j]))) continue;
        if (glm::length(closest(ones[i], twos[j]).apart) > distance) continue;
        ++within;
        EXPECT_LE(from(i, j), time) << "bodies " << a << ' ' << b << ", features " << i << ' ' << j;
      }
    }
  }
  void vertices(Index a, Index b, const auto& from) {
    std::vector<std::array<Index, 1>> ones;
    for (Index v = 0; v < moving.first(a + 1) - moving.first(a); ++v) ones.push_back({v});
    expect(
        a, ones, b, moving.scene.surfaces[b]->triangles(), from,
        [&](const auto& v, const Triangle& f) {
          return closest_vertex_face(at(a, v[0]), at(b, f[0]), at(b, f[1]), at(b, f[2]));
        },
        false);
  }
  void edges(Index a, Index b, const auto& from) {
    expect(
        a, moving.scene.surfaces[a]->edges(), b, moving.scene.surfaces[b]->edges(), from,
        [&](const Edge& e, const Edge& f) { return closest_edges(at(a, e[0]), at(a, e[1]), at(b, f[0]), at(b, f[1])); },
        a == b);
  }
};

/// Looks at several times, from a part of all on, whether all that is within reach was foreseen; returns how much was.
std::size_t expect_complete(const Moving& moving, const SurfaceSearch& search, bool self, std::mt19937& random,
                            float first = 0) {
  std::size_t within = 0;
  for (const float part : {0.0f, 0.13f, 0.5f, 0.77f, 1.0f}) {
    if (part < first) continue;
    const float time = part * moving.seconds;
    const Scene later = moving.after(time, random);
    Moment now{moving, later, time};
    for (Index a = 0; a < moving.traits.size(); ++a)
      for (Index b = self ? a : a + 1; b < moving.traits.size(); ++b) {
        const Surface &sa = *moving.scene.surfaces[a], &sb = *moving.scene.surfaces[b];
        if (!moving.traits[a].moves && !moving.traits[b].moves) continue;
        if (a == b && sa.closed()) continue;  // see StarShaped
        const Candidates candidates(search, a, b, sa, sb);
        now.vertices(a, b, [&](Index i, Index j) { return candidates.vertex_face(i, j); });
        if (a != b) now.vertices(b, a, [&](Index i, Index j) { return candidates.face_vertex(i, j); });
        now.edges(a, b, [&](Index i, Index j) { return candidates.edge_edge(i, j); });
      }
    within += now.within;
  }
  return within;
}

TEST(SurfaceSearch, MissesNothingThatComesWithinReach) {
  std::mt19937 random(61);
  for (const float speed : {0.0f, 0.5f, 10.0f, 200.0f})
    for (const float slack : {0.0f, 0.01f, 0.05f}) {
      std::size_t within = 0;
      for (int trial = 0; trial < 3; ++trial) {
        const Moving m = swarm(random, speed, trial == 0 ? 0.0f : 0.02f, slack);
        const Found found(m, true);
        within += expect_complete(m, found.search, true, random);
      }
      EXPECT_GT(within, 20u) << speed << ' ' << slack;
    }
}

TEST(SurfaceSearch, MissesNothingOfBodiesThatStrayedAndAreForeseenAnew) {
  std::mt19937 random(68);
  constexpr float part = 0.4f;
  for (const float speed : {0.5f, 10.0f}) {
    std::size_t within = 0;
    for (int trial = 0; trial < 6; ++trial) {
      Moving m = swarm(random, speed, 0.02f, 0.01f);
      Found found(m, true);
      const float now = part * m.seconds;
      const Index strayed = trial % 5;
      m.traits[strayed].foresight = trial < 3 ? 0.3f * m.seconds : m.seconds;
      m.traits[strayed].slack = 0.02f, m.traits[strayed].skin = 0.04f;
      const glm::vec3 kick = speed * random_points(random, 1, -1, 1)[0];
      Scene seen = m.after(now, random);
      for (Index v = m.first(strayed); v < m.first(strayed + 1); ++v) {
        found.vx[v] += kick.x, found.vy[v] += kick.y, found.vz[v] += kick.z;
        seen.state.x[v] += 0.05f;
        m.velocity[v] += kick;
        const glm::vec3 start = seen.at(v) - (m.traits[strayed].moves ? now : 0) * m.velocity[v];  // as if always so
        m.scene.state.x[v] = start.x, m.scene.state.y[v] = start.y, m.scene.state.z[v] = start.z;
      }
      EXPECT_EQ(found.search.holds(seen.frame(), now), !m.traits[strayed].moves);
      Workers workers(1);
      found.search.renew({seen.frame(), found.vx, found.vy, found.vz}, m.traits, now, m.seconds, workers);
      if (!m.traits[strayed].moves) continue;
      const float foreseen = found.search.foreseen();
      EXPECT_NEAR(foreseen, trial < 3 ? 0.7f * m.seconds : m.seconds, 1e-6);
      EXPECT_EQ(found.search.holds(seen.frame(), now, 0.5f * m.seconds), trial >= 3);
      if (trial < 3) continue;
      within += expect_complete(m, found.search, true, random, part);
    }
    EXPECT_GT(within, 20u) << speed;
  }
}

TEST(SurfaceSearch, ASheetThatFoldsOntoItselfIsForeseen) {
  std::mt19937 random(62);
  for (const float speed : {1.0f, 20.0f, 300.0f}) {
    Moving m;
    m.seconds = 0.5f / speed;
    m.add(sheet(10, 1), glm::vec3(0), 0.02f, 0.01f, [&](const glm::vec3& v) {
      const glm::vec3 fold = v.x > 0 ? speed * glm::vec3(-3 * v.x, 0.2f, 0) : glm::vec3(0);
      return glm::vec3(5, 7, -3) + glm::cross(glm::vec3(0, speed, speed), v) + fold;
    });
    const Found found(m, true);
    EXPECT_GT(expect_complete(m, found.search, true, random), 100u);
    EXPECT_FALSE(found.search.body(0).unfolded()) << "an open surface";
  }
}

/// Swept over all the seconds that are asked for, each feature would meet each.
TEST(SurfaceSearch, WhatDeformsFastIsForeseenForAShortTimeOnlyUnlessMoreIsAskedFor) {
  std::mt19937 random(69);
  Moving m;
  m.add(sheet(10, 1), glm::vec3(0), 0.02f, 0.01f,
        [&](const glm::vec3&) { return glm::vec3(7, 0, 0) + 1000.0f * random_points(random, 1, -1, 1)[0]; });
  const Found all(m, true);
  EXPECT_EQ(all.search.foreseen(), m.seconds);
  m.whole = false;
  const Found some(m, true);
  EXPECT_NEAR(some.search.foreseen() * some.search.body(0).most_strain(), 0.5f * m.traits[0].edge, 1e-4f);
  EXPECT_LT(some.search.features().size(), all.search.features().size() / 4);
  m.seconds = some.search.foreseen();
  EXPECT_GT(expect_complete(m, some.search, true, random), 0u);
}

/// The motion of each ends at a time of its own.
TEST(SurfaceSearch, MissesNothingOfBodiesThatAreForeseenForAShortTimeOnly) {
  std::mt19937 random(70);
  for (const float speed : {10.0f, 100.0f}) {
    std::size_t within = 0, renewals = 0;
    for (int trial = 0; trial < 3; ++trial) {
      Moving m = swarm(random, speed, 0.02f, 0.01f);
      m.whole = false;
      for (std::size_t i = 0; i < m.velocity.size(); ++i) m.velocity[i] *= i % 3 == 0 ? 0.2f : 1.0f;
      Found found(m, true);
      const float all = m.seconds;
      Workers workers(1);
      for (float now = 0; now < all; now = found.search.foreseen()) {
        if (now > 0) {
          const Scene seen = m.after(now, random);
          ASSERT_FALSE(found.search.holds(seen.frame(), now, 1e-3f * all));
          // From where it has strayed to it goes on as it did.
          for (Index v = 0; v < m.velocity.size(); ++v) {
            const Index body = static_cast<Index>(std::upper_bound(m.scene.state.bodies.first.begin(),
                                                                   m.scene.state.bodies.first.end(), v) -
                                                  m.scene.state.bodies.first.begin()) -
                               1;
            if (!found.search.body(body).due() || !m.traits[body].moves) continue;
            const glm::vec3 start = seen.at(v) - now * m.velocity[v];
            m.scene.state.x[v] = start.x, m.scene.state.y[v] = start.y, m.scene.state.z[v] = start.z;
          }
          found.search.renew({seen.frame(), found.vx, found.vy, found.vz}, m.traits, now, 0, workers);
          ++renewals;
        }
        m.seconds = found.search.foreseen();
        within += expect_complete(m, found.search, true, random, now / m.seconds);
      }
    }
    EXPECT_GT(within, 20u) << speed;
    EXPECT_GT(renewals, 10u) << speed;
  }
}

}  // namespace
}  // namespace collide::test
