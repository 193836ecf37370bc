#pragma once
// Vertices in motion with the features that they make, and the search for pairs of features.

#include <algorithm>
#include <array>
#include <compare>
#include <functional>
#include <optional>
#include <type_traits>
#include <vector>

#include "collide/core/workers.h"
#include "collide/oracle/moving_features.h"
#include "collide/surface/box_tree.h"
#include "collide/surface/surface.h"

namespace collide::oracle {

/// Features of a mesh, as numbers of its points. A face may name a vertex twice.
struct MovingMesh {
  using Vertex = std::array<Index, 1>;
  std::vector<MovingPoint> points;   // finite where a feature uses them
  std::vector<Index> body;           // of each point; the search is faster if bodies follow one another in the lists
  std::vector<Vertex> vertices;      // ascending
  std::vector<surface::Edge> edges;  // ascending, each once
  std::vector<surface::Triangle> faces;  // in any order
};

/// A vertex and a face, or two edges of which the smaller one comes first. They have no common vertex.
struct MovingPair {
  using Kind = MovingFeatures::Kind;
  Kind kind;
  std::array<Index, 2> feature;  // {vertex, vertex}, or the ends of the edge
  std::array<Index, 3> against;  // the face, or {end, end, end} of the edge
  auto operator<=>(const MovingPair&) const = default;
};

/// Returns the first meeting of two features; their first passage.
std::optional<Meeting> meeting_of(const MovingMesh& mesh, const MovingPair& pair);
std::optional<Passage> passage_of(const MovingMesh& mesh, const MovingPair& pair);

inline MovingPair pair_of(const MovingMesh::Vertex& v, const surface::Triangle& face) {
  return {MovingPair::Kind::vertex_face, {v[0], v[0]}, face};
}
inline MovingPair pair_of(const surface::Edge& a, const surface::Edge& b) {
  return {MovingPair::Kind::edge_edge, a, {b[0], b[1], b[1]}};
}

template <std::size_t N>
surface::MovingBox box_of(const MovingMesh& mesh, const std::array<Index, N>& feature) {
  surface::MovingBox box;
  for (const Index v : feature) box.add(mesh.points[v].from, mesh.points[v].to);
  return box;
}

/// Trees of the boxes of features: one for each run of features of one body in their list, and one over all runs.
class FeatureTrees {
 public:
  template <class Feature>
  FeatureTrees(const MovingMesh& mesh, const std::vector<Feature>& features, Workers& workers) {
    for (Index k = 0; k < features.size(); ++k)
      if (k == 0 || mesh.body[features[k][0]] != mesh.body[features[k - 1][0]]) begin_.push_back(k);
    trees_.resize(begin_.size());
    std::vector<surface::MovingBox> boxes(begin_.size());
    constexpr double feature_ns = 200;  // of work
    const int threads = workers.threads_for(feature_ns * static_cast<double>(features.size()));
    workers.share(threads, trees_.size(), [&](int, std::size_t run) {
      std::vector<surface::MovingBox> of_run;
      const std::size_t end = run + 1 < begin_.size() ? begin_[run + 1] : features.size();
      for (std::size_t k = begin_[run]; k < end; ++k) of_run.push_back(box_of(mesh, features[k]));
      trees_[run] = surface::MovingBoxTree(of_run);
      boxes[run] = trees_[run].box();
    });
    runs_ = surface::MovingBoxTree(boxes);
  }
  /// Calls take(k) for each feature k whose box overlaps `box`.
  template <class Take>
  void for_each_overlapping(const surface::MovingBox& box, const Take& take) const {
    runs_.for_each_overlapping(
        box, [&](Index run) { trees_[run].for_each_overlapping(box, [&](Index k) { take(begin_[run] + k); }); });
  }

 private:
  std::vector<Index> begin_;  // of each run
  std::vector<surface::MovingBoxTree> trees_;
  surface::MovingBoxTree runs_;
};

/// Searches some features of a mesh against others.
template <class Found, class Feature, class Other, class Ask, class Take>
void search_features(const MovingMesh& mesh, const std::vector<Feature>& features, const std::vector<Other>& others,
                     Workers& workers, const Ask& ask, const Take& take) {
  const FeatureTrees trees(mesh, others, workers);
  const auto look_at = [&](const Feature& feature, std::vector<Found>& found) {
    trees.for_each_overlapping(box_of(mesh, feature), [&](Index k) {
      const Other& other = others[k];
      if constexpr (std::is_same_v<Feature, Other>) {
        if (!(feature < other)) return;
      }
      if (std::find_first_of(feature.begin(), feature.end(), other.begin(), other.end()) != feature.end()) return;
      if (const std::optional<Found> answer = ask(pair_of(feature, other))) found.push_back(*answer);
    });
  };
  constexpr std::size_t slice = 1 << 14;
  constexpr double search_ns = 500;  // of work, of a feature
  const int parts = workers.threads_for(search_ns * static_cast<double>(std::min(slice, features.size())));
  std::vector<std::vector<Found>> found(static_cast<std::size_t>(parts));
  for (std::size_t begin = 0; begin < features.size(); begin += slice) {
    const std::size_t end = std::min(begin + slice, features.size());
    workers.share(parts, end - begin, [&](int thread, std::size_t k) {
      look_at(features[begin + k], found[static_cast<std::size_t>(thread)]);
    });
    std::vector<Found>& all = found.front();
    for (std::size_t other = 1; other < found.size(); ++other) {
      all.insert(all.end(), found[other].begin(), found[other].end());
      found[other].clear();
    }
    std::sort(all.begin(), all.end(), [](const MovingPair& a, const MovingPair& b) { return a < b; });
    take(all);
    all.clear();
  }
}

/// Finds pairs of features that share a point at some time, or more: calls ask(pair) for every pair of a vertex and a
/// face, and of two edges, unless their boxes prove that they do not meet. ask returns nothing or what it found, of the
/// type Found, which is derived from MovingPair; all threads call it. take(found) gets this in ascending order, part
/// by part, on the calling thread. So memory is needed for the mesh and for one part. The order does not depend on the
/// number of threads.
template <class Found, class Ask, class Take>
void search_pairs(const MovingMesh& mesh, Workers& workers, const Ask& ask, const Take& take) {
  search_features<Found>(mesh, mesh.vertices, mesh.faces, workers, ask, take);
  search_features<Found>(mesh, mesh.edges, mesh.edges, workers, ask, take);
}

struct FeatureMeeting : MovingPair {
  Meeting first;
  bool passes;  // the side changes at some time at which they meet
};

/// Finds all meetings of features, exactly. take: see search_pairs().
void find_meetings(const MovingMesh& mesh, Workers& workers,
                   const std::function<void(const std::vector<FeatureMeeting>&)>& take);

}  // namespace collide::oracle
