// bench_ccd: what queries of continuous collision detection take, by sets of queries: those of files, and those that a
// simulation asks. Each query counts with the least of five runs.
//
//   bench_ccd [FILE...]      files of the public benchmark, see tests/collide/ccd_queries.h

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <limits>
#include <string>

#include "collide/surface/box_tree.h"
#include "collide/surface/surface.h"
#include "softbody/model/body_model.h"
#include "softbody/world/world.h"
#include "tests/collide/ccd_queries.h"

namespace {

using collide::Index;
using collide::oracle::MovingPoint;
using collide::surface::Box;
using collide::test::Query;

struct Timings {
  double mean = 0, slowest = 0;  // us
};

template <class Ask>
Timings time_queries(const std::vector<Query>& queries, const Ask& ask) {
  using Clock = std::chrono::steady_clock;
  constexpr int runs = 5;
  const auto infinity = std::numeric_limits<double>::infinity();
  std::vector<double> least(queries.size(), infinity);
  double mean = infinity;
  for (int run = 0; run < runs; ++run) {
    // To look at the clock takes longer than most queries, so the mean is that of many in a row, by processor time.
    const std::size_t rounds = 1 + 100'000 / queries.size();
    const std::clock_t begin = std::clock();
    for (std::size_t round = 0; round < rounds; ++round) {
      for (const Query& query : queries) ask(query);
    }
    const double us = 1e6 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    mean = std::min(mean, us / static_cast<double>(rounds * queries.size()));
    for (std::size_t k = 0; k < queries.size(); ++k) {
      const auto start = Clock::now();
      ask(queries[k]);
      least[k] = std::min(least[k], std::chrono::duration<double, std::micro>(Clock::now() - start).count());
    }
  }
  return {mean, *std::max_element(least.begin(), least.end())};
}

/// known: whether each query is one of features that meet; empty if that is not known.
void report(const std::string& name, const std::vector<Query>& queries, const std::vector<bool>& known = {}) {
  if (queries.empty()) return;
  std::size_t met = 0, missed = 0, wrong = 0;
  for (std::size_t k = 0; k < queries.size(); ++k) {
    const bool meets = collide::oracle::meeting_of(queries[k]).has_value();
    met += meets;
    if (known.empty()) continue;
    missed += known[k] && !meets;
    wrong += !known[k] && meets;
  }
  const Timings meets =
      time_queries(queries, [](const Query& q) { return collide::oracle::meeting_of(q).has_value(); });
  const Timings passes =
      time_queries(queries, [](const Query& q) { return collide::oracle::passage_of(q).has_value(); });
  const auto errors = [&](std::size_t count) { return known.empty() ? "" : std::to_string(count); };
  std::printf("| %s | %zu | %zu | %s | %s | %.3g | %.3g | %.3g | %.3g |\n", name.c_str(), queries.size(), met,
              errors(missed).c_str(), errors(wrong).c_str(), meets.mean, meets.slowest, passes.mean, passes.slowest);
}

/// All vertices of a world at two times, and its features as numbers of vertices.
struct Motion {
  std::vector<MovingPoint> points;
  std::vector<std::array<Index, 3>> faces;
  std::vector<std::array<Index, 2>> edges;

  template <std::size_t N>
  std::vector<Box> boxes_of(const std::vector<std::array<Index, N>>& features) const {
    std::vector<Box> boxes;
    for (const auto& feature : features) {
      Box& box = boxes.emplace_back();
      for (const Index v : feature) {
        box.add(points[v].from);
        box.add(points[v].to);
      }
    }
    return boxes;
  }
};

/// Returns the motion of a world in its next frame.
Motion next_frame(softbody::World& world) {
  Motion motion;
  const auto position = [&](Index v) { return glm::dvec3(collide::position(world.positions(), v)); };
  for (Index v = 0; v < world.bodies().vertex_count(); ++v) motion.points.push_back({position(v), {}});
  world.step();
  for (Index v = 0; v < motion.points.size(); ++v) motion.points[v].to = position(v);
  for (Index body = 0; body < world.bodies().count() && world.bodies().first[body] < motion.points.size(); ++body) {
    const Index first = world.bodies().first[body];
    if (!world.model(body).surface) continue;
    for (const auto& t : world.model(body).surface->triangles())
      motion.faces.push_back({first + t[0], first + t[1], first + t[2]});
    for (const auto& e : world.model(body).surface->edges()) motion.edges.push_back({first + e[0], first + e[1]});
  }
  return motion;
}

/// Returns the queries of all pairs of features without a common vertex whose boxes, swept over the motion, overlap.
std::vector<Query> queries_of(const Motion& motion) {
  std::vector<Query> queries;
  const auto& p = motion.points;
  std::vector<std::array<Index, 1>> vertices(p.size());
  for (Index v = 0; v < p.size(); ++v) vertices[v] = {v};
  const auto pairs = [&](const auto& features, const auto& others, const auto& take) {
    const std::vector<Box> boxes = motion.boxes_of(features);
    const collide::surface::BoxTree tree(motion.boxes_of(others));
    for (Index k = 0; k < features.size(); ++k) {
      tree.for_each_overlapping(boxes[k], [&](Index other) {
        const auto& a = features[k];
        const auto& b = others[other];
        if (std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) == a.end()) take(a, b);
      });
    }
  };
  pairs(vertices, motion.faces, [&](const auto& v, const auto& f) {
    queries.push_back({Query::Kind::vertex_face, {p[v[0]], p[f[0]], p[f[1]], p[f[2]]}});
  });
  pairs(motion.edges, motion.edges, [&](const auto& a, const auto& b) {
    if (a < b) queries.push_back({Query::Kind::edge_edge, {p[a[0]], p[a[1]], p[b[0]], p[b[1]]}});
  });
  return queries;
}

void run(int argc, char** argv) {
  std::puts(
      "| queries | number | that meet | false negatives | false positives | meets: mean, µs | slowest | passes: mean, "
      "µs | slowest |");
  std::puts("|---|--:|--:|--:|--:|--:|--:|--:|--:|");
  for (int k = 1; k < argc; ++k) {
    const std::filesystem::path file = argv[k];
    std::vector<Query> queries;
    std::vector<bool> meet;
    for (const collide::test::KnownQuery& query : collide::test::read_queries(file)) {
      queries.push_back(query);
      meet.push_back(query.meets);
    }
    report(file.stem(), queries, meet);
  }
  for (const char* name : {"D", "drop-3000", "cloth"}) {
    softbody::World world(softbody::load_scene(std::string(SBCOLLIDE_SCENES) + "/" + name + ".toml"), {});
    while (world.frame() < 240) world.step();
    report(std::string(name) + ", frame 240", queries_of(next_frame(world)));
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(argc, argv);
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
