// bench_ccd: what queries of continuous collision detection take, by sets of queries: those of files, and those that a
// simulation asks. Each query counts with the least of five runs.
//
//   bench_ccd [FILE...]      files of the public benchmark, see tests/collide/ccd_queries.h

#include <algorithm>
#include <chrono>
#include <cstdio>
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
  std::vector<double> least(queries.size(), std::numeric_limits<double>::infinity());
  double mean = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    // The clock takes part of what a query takes, so that the mean is of all queries in a row.
    const auto begin = Clock::now();
    for (const Query& query : queries) ask(query);
    mean = std::min(mean, std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
    for (std::size_t k = 0; k < queries.size(); ++k) {
      const auto start = Clock::now();
      ask(queries[k]);
      least[k] = std::min(least[k], std::chrono::duration<double, std::micro>(Clock::now() - start).count());
    }
  }
  return {mean / static_cast<double>(queries.size()), *std::max_element(least.begin(), least.end())};
}

void report(const std::string& name, const std::vector<Query>& queries) {
  if (queries.empty()) return;
  std::size_t met = 0;
  for (const Query& query : queries) met += collide::test::meeting_of(query).has_value();
  const Timings meets = time_queries(queries, [](const Query& q) { return collide::test::meeting_of(q).has_value(); });
  const Timings passes = time_queries(queries, [](const Query& q) { return collide::test::passage_of(q).has_value(); });
  std::printf("| %s | %zu | %zu | %.3g | %.3g | %.3g | %.3g |\n", name.c_str(), queries.size(), met, meets.mean,
              meets.slowest, passes.mean, passes.slowest);
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
  const auto position = [&](Index v) {
    const collide::Frame now = world.positions();
    return glm::dvec3(now.x[v], now.y[v], now.z[v]);
  };
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
  std::puts("| queries | number | that meet | meets: mean, us | slowest | passes: mean, us | slowest |");
  std::puts("|---|--:|--:|--:|--:|--:|--:|");
  for (int k = 1; k < argc; ++k) {
    const std::filesystem::path file = argv[k];
    const auto known = collide::test::read_queries(file);
    report(file.stem(), {known.begin(), known.end()});
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
