// The candidates of surface contact are complete: all features that come within their contact distance are among them.

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <map>

#include "moving_surfaces.h"

namespace collide::test {

using namespace collide::surface;
namespace THIS_FILE {

using Kind = MovingFeatures::Kind;

/// The earliest times of the candidates of two bodies: by kind and features, the vertex or the edge of `one` first.
class Candidates {
 public:
  Candidates(const SurfaceSearch& search, Index a, Index b) {
    const auto list = [&](Index one, Kind kind, std::uint32_t begin, std::uint32_t end) {
      for (const FeaturePair& f : std::span(search.features()).subspan(begin, end - begin))
        earliest_[{one, kind, f.a, f.b}] = f.earliest;
    };
    for (const SurfacePair& p : search.pairs()) {
      if (p.a != a || p.b != b) continue;
      list(a, Kind::vertex_face, p.vertex_face, p.face_vertex);
      list(b, Kind::vertex_face, p.face_vertex, p.edge_edge);
      list(a, Kind::edge_edge, p.edge_edge, p.end);
    }
  }
  /// Returns infinity for features that are no candidates.
  float earliest(Index one, Kind kind, Index i, Index j) const {
    const auto found = earliest_.find({one, kind, i, j});
    return found == earliest_.end() ? std::numeric_limits<float>::infinity() : found->second;
  }

 private:
  std::map<std::tuple<Index, Kind, Index, Index>, float> earliest_;
};

/// An instant at which all pairs of features are tested, by plain loops.
struct Instant {
  const MovingScene& moving;
  const Scene& scene;
  float time;
  std::size_t within = 0;  // pairs that were within their contact distance

  glm::vec3 at(Index body, Index v) const { return scene.at(moving.first(body) + v); }
  template <std::size_t n>
  Aabb box(Index body, const std::array<Index, n>& corners, float margin) const {
    Aabb all{at(body, corners[0]), at(body, corners[0])};
    for (const Index v : corners) all = {glm::min(all.lo, at(body, v)), glm::max(all.hi, at(body, v))};
    return {all.lo - margin, all.hi + margin};
  }
  template <std::size_t n, std::size_t m>
  static bool share_vertex(const std::array<Index, n>& a, const std::array<Index, m>& b) {
    return std::any_of(a.begin(), a.end(), [&](Index v) { return std::find(b.begin(), b.end(), v) != b.end(); });
  }
  float contact_offset(Index body) const { return moving.traits[body].skin - moving.traits[body].slack; }

  /// Expects every pair within its contact distance to be a candidate. closest(one, two): their closest points.
  template <class Ones, class Twos, class ClosestOf>
  void expect(const Candidates& candidates, Index a, const Ones& ones, Index b, const Twos& twos, Kind kind,
              const ClosestOf& closest) {
    const float distance = contact_offset(a) + contact_offset(b);
    std::vector<Aabb> boxes;
    for (const auto& two : twos) boxes.push_back(box(b, two, 0));
    for (Index i = 0; i < ones.size(); ++i) {
      const Aabb near_one = box(a, ones[i], distance);
      for (Index j = a == b && kind == Kind::edge_edge ? i + 1 : 0; j < twos.size(); ++j) {
        if (!near(near_one, boxes[j], 0) || (a == b && share_vertex(ones[i], twos[j]))) continue;
        if (glm::length(closest(ones[i], twos[j]).separation) > distance) continue;
        ++within;
        EXPECT_LE(candidates.earliest(a, kind, i, j), time)
            << "bodies " << a << ' ' << b << ", features " << i << ' ' << j;
      }
    }
  }
  void expect_vertices(const Candidates& candidates, Index a, Index b) {
    std::vector<std::array<Index, 1>> ones;
    for (Index v = 0; v < moving.first(a + 1) - moving.first(a); ++v) ones.push_back({v});
    expect(candidates, a, ones, b, moving.scene.surfaces[b]->triangles(), Kind::vertex_face,
           [&](const auto& v, const Triangle& f) {
             return closest_vertex_face(at(a, v[0]), at(b, f[0]), at(b, f[1]), at(b, f[2]));
           });
  }
  void expect_edges(const Candidates& candidates, Index a, Index b) {
    expect(candidates, a, moving.scene.surfaces[a]->edges(), b, moving.scene.surfaces[b]->edges(), Kind::edge_edge,
           [&](const Edge& e, const Edge& f) {
             return closest_edges(at(a, e[0]), at(a, e[1]), at(b, f[0]), at(b, f[1]));
           });
  }
};

/// Expects the candidates to be complete at several times, from the share `first` of the duration on. Returns how many
/// pairs were within their contact distance.
std::size_t expect_complete(const MovingScene& moving, const SurfaceSearch& search, bool self, std::mt19937& random,
                            float first = 0) {
  std::size_t within = 0;
  for (const float share : {0.0f, 0.13f, 0.5f, 0.77f, 1.0f}) {
    if (share < first) continue;
    const float time = share * moving.seconds;
    const Scene later = moving.after(time, random);
    Instant now{moving, later, time};
    for (Index a = 0; a < moving.traits.size(); ++a)
      for (Index b = self ? a : a + 1; b < moving.traits.size(); ++b) {
        if (!moving.traits[a].moves && !moving.traits[b].moves) continue;
        if (a == b && moving.scene.surfaces[a]->closed()) continue;  // see the tests of SweptBody
        const Candidates candidates(search, a, b);
        now.expect_vertices(candidates, a, b);
        if (a != b) now.expect_vertices(candidates, b, a);
        now.expect_edges(candidates, a, b);
      }
    within += now.within;
  }
  return within;
}

TEST(SurfaceSearch, FindsAllFeaturesThatComeWithinContactDistance) {
  std::mt19937 random(61);
  for (const float speed : {0.0f, 0.5f, 10.0f, 200.0f})
    for (const float slack : {0.0f, 0.01f, 0.05f}) {
      std::size_t within = 0;
      for (int trial = 0; trial < 3; ++trial) {
        const MovingScene m = swarm(random, speed, trial == 0 ? 0.0f : 0.02f, slack);
        const SearchRun run(m, true);
        within += expect_complete(m, run.search, true, random);
      }
      EXPECT_GT(within, 20u) << speed << ' ' << slack;
    }
}

TEST(SurfaceSearch, UpdateFindsAllCandidatesOfExpiredBodies) {
  std::mt19937 random(68);
  constexpr float share = 0.4f;
  for (const float speed : {0.5f, 10.0f}) {
    std::size_t within = 0;
    for (int trial = 0; trial < 6; ++trial) {
      MovingScene m = swarm(random, speed, 0.02f, 0.01f);
      SearchRun run(m, true);
      const float now = share * m.seconds;
      const Index expired = trial % 5;
      m.traits[expired].horizon = trial < 3 ? 0.3f * m.seconds : m.seconds;
      m.traits[expired].slack = 0.02f, m.traits[expired].skin = 0.04f;
      const glm::vec3 kick = speed * random_points(random, 1, -1, 1)[0];
      Scene seen = m.after(now, random);
      for (Index v = m.first(expired); v < m.first(expired + 1); ++v) {
        run.vx[v] += kick.x, run.vy[v] += kick.y, run.vz[v] += kick.z;
        seen.state.x[v] += 0.05f;
        m.velocity[v] += kick;
        const glm::vec3 start =
            seen.at(v) - (m.traits[expired].moves ? now : 0) * m.velocity[v];  // as if it had always moved so
        m.scene.state.x[v] = start.x, m.scene.state.y[v] = start.y, m.scene.state.z[v] = start.z;
      }
      EXPECT_EQ(run.search.check_valid(seen.frame(), now), !m.traits[expired].moves);
      Workers workers(1);
      run.search.update({seen.frame(), run.vx, run.vy, run.vz}, m.traits, now, m.seconds, workers);
      if (!m.traits[expired].moves) continue;
      const float predicted_until = run.search.predicted_until();
      EXPECT_NEAR(predicted_until, trial < 3 ? 0.7f * m.seconds : m.seconds, 1e-6);
      EXPECT_EQ(run.search.check_valid(seen.frame(), now, 0.5f * m.seconds), trial >= 3);
      if (trial < 3) continue;
      within += expect_complete(m, run.search, true, random, share);
    }
    EXPECT_GT(within, 20u) << speed;
  }
}

TEST(SurfaceSearch, FindsAllCandidatesWithinAFoldingSheet) {
  std::mt19937 random(62);
  for (const float speed : {1.0f, 20.0f, 300.0f}) {
    MovingScene m;
    m.seconds = 0.5f / speed;
    m.add(sheet(10, 1), glm::vec3(0), 0.02f, 0.01f, [&](const glm::vec3& v) {
      const glm::vec3 fold = v.x > 0 ? speed * glm::vec3(-3 * v.x, 0.2f, 0) : glm::vec3(0);
      return glm::vec3(5, 7, -3) + glm::cross(glm::vec3(0, speed, speed), v) + fold;
    });
    const SearchRun run(m, true);
    EXPECT_GT(expect_complete(m, run.search, true, random), 100u);
    EXPECT_FALSE(run.search.body(0).stays_star_shaped()) << "an open surface";
  }
}

/// Contact distances of 0.02 and 2 mean edges, and positions that are rounded to 0.06 mm.
TEST(SurfaceSearch, FindsAllCandidatesWithinACrumpledSheetFarFromTheOrigin) {
  std::mt19937 random(74);
  for (const float distance : {0.0f, 1000.0f})
    for (const float contact_offset : {0.001f, 0.1f}) {
      MovingScene m;
      SurfaceMesh mesh = sheet(12, 1);
      for (glm::vec3& v : mesh.vertices) v = 0.4f * v + random_points(random, 1, -0.06f, 0.06f)[0];
      m.add(mesh, glm::vec3(distance, -distance, 0), contact_offset, 0.002f,
            [&](const glm::vec3&) { return random_points(random, 1, -1, 1)[0]; });
      m.seconds = 0.01f;
      const SearchRun run(m, true);
      EXPECT_GT(expect_complete(m, run.search, true, random), 100u) << distance << ' ' << contact_offset;
    }
}

/// If the features were swept over all of `seconds`, every box would overlap every other.
TEST(SurfaceSearch, PredictsFastDeformationForAShortTimeUnlessMinSecondsIsLonger) {
  std::mt19937 random(69);
  MovingScene m;
  m.add(sheet(10, 1), glm::vec3(0), 0.02f, 0.01f,
        [&](const glm::vec3&) { return glm::vec3(7, 0, 0) + 1000.0f * random_points(random, 1, -1, 1)[0]; });
  const SearchRun all(m, true);
  EXPECT_EQ(all.search.predicted_until(), m.seconds);
  m.whole = false;
  const SearchRun some(m, true);
  EXPECT_NEAR(some.search.predicted_until() * some.search.body(0).max_deformation_speed(),
              0.25f * m.traits[0].mean_edge, 1e-4f);
  EXPECT_LT(some.search.features().size(), all.search.features().size() / 4);
  m.seconds = some.search.predicted_until();
  EXPECT_GT(expect_complete(m, some.search, true, random), 0u);
}

/// The prediction of each body ends at a different time.
TEST(SurfaceSearch, FindsAllCandidatesIfPredictionsEndAtDifferentTimes) {
  std::mt19937 random(70);
  for (const float speed : {10.0f, 100.0f}) {
    std::size_t within = 0, updates = 0;
    for (int trial = 0; trial < 3; ++trial) {
      MovingScene m = swarm(random, speed, 0.02f, 0.01f);
      m.whole = false;
      for (std::size_t i = 0; i < m.velocity.size(); ++i) m.velocity[i] *= i % 3 == 0 ? 0.2f : 1.0f;
      SearchRun run(m, true);
      const float all = m.seconds;
      Workers workers(1);
      for (float now = 0; now < all; now = run.search.predicted_until()) {
        if (now > 0) {
          const Scene seen = m.after(now, random);
          ASSERT_FALSE(run.search.check_valid(seen.frame(), now, 1e-3f * all));
          // It keeps its velocity at the position to which it has deviated.
          for (Index v = 0; v < m.velocity.size(); ++v) {
            const Index body = m.scene.state.bodies.body_of(v);
            if (!run.search.body(body).expired() || !m.traits[body].moves) continue;
            const glm::vec3 start = seen.at(v) - now * m.velocity[v];
            m.scene.state.x[v] = start.x, m.scene.state.y[v] = start.y, m.scene.state.z[v] = start.z;
          }
          run.search.update({seen.frame(), run.vx, run.vy, run.vz}, m.traits, now, 0, workers);
          ++updates;
        }
        m.seconds = run.search.predicted_until();
        within += expect_complete(m, run.search, true, random, now / m.seconds);
      }
    }
    EXPECT_GT(within, 20u) << speed;
    EXPECT_GT(updates, 10u) << speed;
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
