#pragma once
// Finds the candidates for the contact of surfaces: the pairs of a vertex and a face, and the pairs of two edges, that
// can come within their contact distance while the bodies move on for a while. The contact distance of two features is
// the sum of the contact offsets of their bodies, see SurfaceBody.
//
// The stages are those of the exact detector: a box for each body, a broad phase that finds the bodies whose boxes
// overlap, and patches of 16 features. But here the boxes enclose features and are swept over their motion (continuous
// collision detection), so that no fast feature passes through another unnoticed. If a body leaves its predicted path,
// only this body is predicted again, and only its pairs are searched again. All other pairs keep their candidates.
//
// Proof that no candidate is missing, as long as every vertex stays within its body's slack of its predicted path
// x + v t (see check_valid()). Time t runs from 0 to T.
//   Two bodies. Let u_a and u_b be the mean velocities of bodies a and b. Consider the frame of reference that moves
// with u_b. There, the displacement of a vertex of a from x has two parts. The first part, (v - u_a) t, lies in the box
// spanned by 0 and (v - u_a) T. The second part is the displacement of the frame of a relative to the frame of b; it
// lies in the box spanned by the first and the last such displacement. So the vertex stays in the sum of these two
// boxes around x, grown by the slack. A vertex of b has only the first part, (v - u_b) t. The search grows the boxes of
// each body by the skin instead, which is larger by the contact offset. Therefore, if two features come within their
// contact distance, their boxes overlap, and they are candidates.
//   One body. Let r_i be the position of vertex i relative to the centre. For any u and w, let v_i = u + w x r_i + s_i:
// s_i is the velocity of the deformation. Let [w] be the matrix with [w] r = w x r, and A = 1 + t [w]. Then
//   (x_i + v_i t) - (x_j + v_j t) = A (r_i - r_j) + t (s_i - s_j),
// and the length of this is at least |A (r_i - r_j)| - t |s_i - s_j|. Since w x r is normal to r, |A r| >= |r| for all
// r: rotation brings no two points closer. All this holds for points of features, which are means of their corners. So
// features come closer by at most t times the largest |s_i - s_j| of their corners, and by the slack of each. The
// search grows the box of each feature by half of the contact distance, its slack, the way |s_i| T of its fastest
// corner, and what rounding may take.

#include <tuple>
#include <utility>
#include <vector>

#include "collide/core/workers.h"
#include "collide/surface/feature_batch.h"
#include "collide/surface/pair_sort.h"
#include "collide/surface/swept_body.h"

namespace collide::surface {

/// Two features, by their local numbers.
struct FeaturePair {
  Index a, b;
  float earliest;  // s after find(): until then they are farther apart than 1.1 times their contact distance
  auto key() const { return std::pair(a, b); }
};

/// The candidates of two bodies, or of one body with itself (a == b), as ranges in SurfaceSearch::features(). A pair
/// without candidates is listed only if one body may be wholly inside the other.
struct SurfacePair {
  Index a, b;                 // bodies, a <= b
  std::uint32_t vertex_face;  // first pair of a vertex of a and a face of b
  std::uint32_t face_vertex;  // first pair of a vertex of b and a face of a; no such pairs if a == b
  std::uint32_t edge_edge;    // first pair of an edge of a and an edge of b; the smaller edge first if a == b
  std::uint32_t end;
  auto bodies() const { return std::pair(a, b); }
};

/// The arguments of a search.
struct SurfaceQuery {
  float seconds = 0;      // s: candidates are found for this long
  float min_seconds = 0;  // s: no prediction is shorter, see SweptBody::predict()
  bool self = false;      // also find candidates within a body
  std::size_t max_features = std::size_t{1} << 24;
};

class SurfaceSearch {
 public:
  /// Finds all candidates from now on until predicted_until(): bodies ascending, and features ascending within each
  /// range. Leaves out bodies that are not finite. bodies: one for each body of the motion; their surfaces must stay
  /// alive until the next find(). Throws std::length_error if there are more than query.max_features candidates or too
  /// many overlapping boxes; then all earlier candidates are invalid, too.
  void find(const Motion& motion, std::span<const SurfaceBody> bodies, const SurfaceQuery& query, Workers& workers);
  /// Predicts the bodies again whose predictions have expired, and finds the candidates of their pairs, `elapsed`
  /// seconds after find(). Each new prediction lasts at least min_seconds, but not beyond what find() was asked for.
  /// bodies: as many as in find(); their values may have changed. Reads the motion of expired bodies only. Throws as
  /// find() does.
  void update(const Motion& motion, std::span<const SurfaceBody> bodies, float elapsed, float min_seconds,
              Workers& workers);
  void clear();

  const std::vector<SurfacePair>& pairs() const { return current_.pairs; }
  const std::vector<FeaturePair>& features() const { return current_.features; }
  /// Returns the work of the last find() or update(): the sum of boxes built, overlapping pairs of boxes, and
  /// candidates.
  std::size_t work() const { return work_; }
  /// Returns the candidates that features() held before the last find() or update().
  const std::vector<FeaturePair>& previous_features() const { return previous_.features; }
  /// How well the last prediction of a body fitted its motion.
  struct History {
    float deviation;  // m
    float duration;   // s, from the start of the prediction to the end of what find() was asked for
  };
  History history(Index body) const { return {swept_[body].deviation(), end_ - swept_[body].begin()}; }
  /// Sets features() and history() to those of an earlier search; one history for each body. pairs() is empty until the
  /// next find().
  void restore(std::vector<FeaturePair> features, std::span<const History> history);

  /// Measures the deviations of all bodies, whose positions are `now`, `elapsed` seconds after find(). Returns true if
  /// the candidates are complete and will be for another `ahead` seconds; else some predictions have expired.
  bool check_valid(const Frame& now, float elapsed, float ahead = 0);
  /// Returns until when (s after find()) the motion of all bodies is predicted.
  float predicted_until() const { return predicted_until_; }
  /// Returns until when (s after find()) the candidates are likely to be complete, by what the last check_valid() saw.
  float holds_until() const;
  /// Returns the last prediction of a body, and its largest deviation in any check_valid() since.
  const SweptBody& body(Index body) const { return swept_[body]; }

  /// Returns an upper bound (m/s) of the relative speed of any vertices of two bodies, as predicted; of a body and
  /// itself, without its rigid motion.
  float max_relative_speed(Index a, Index b) const;

 private:
  struct Candidates {
    std::vector<SurfacePair> pairs;
    std::vector<FeaturePair> features;
  };
  struct alignas(64) Thread {
    PatchBoxes ones, twos;     // of the features of a body
    std::vector<float> rooms;  // m, of its vertices
    OverlapSearch search;
    FeatureBatch batch;
    PairSort<FeaturePair> sort;
    std::vector<FeaturePair> features;
    std::size_t work = 0;
  };
  /// One kind of candidates of two bodies, or of a body and itself (a == b, without face_vertex), as in SurfacePair.
  /// Threads take tasks as they come; found candidates are put in the order of the tasks.
  struct Task {
    enum class Kind : std::uint8_t { vertex_face, face_vertex, edge_edge };
    Index a, b;
    Kind kind;
    const std::vector<FeaturePair>* in = nullptr;  // where its candidates are
    std::size_t begin = 0, end = 0;
    auto key() const { return std::tuple(a, b, kind); }
  };
  void search(const Motion& motion, float min_seconds, Workers& workers);
  void check_feature_limit(std::size_t features) const;
  void find_tasks();
  void find_candidates(Thread& own, Task& task);
  void find_between(Thread& own, Index first, const PatchBoxes& boxes, Index later, const PatchBoxes& others) const;
  void find_within(Thread& own, Index body, const FeaturePatches& ones, const FeaturePatches& twos) const;
  void reuse_previous(Task& task) const;
  void merge_tasks();
  float reach(Index a, Index b) const;
  template <PairKind kind>
  void add_reachable(Thread& own, Index a, Index b) const;

  std::span<const SurfaceBody> bodies_;
  SurfaceQuery query_;
  float time_ = 0, end_ = 0, predicted_until_ = 0;  // s after find()
  std::vector<SweptBody> swept_;
  // One value for each body:
  std::vector<char> predicted_anew_;    // it was predicted again in this search
  std::vector<char> may_touch_itself_;  // as it is predicted
  std::vector<char> needs_boxes_;       // it is in a near pair of which a body was predicted again
  std::vector<char> has_boxes_;         // the boxes of its features are those of its last prediction
  std::vector<Index> order_;            // scratch of the sweep
  std::vector<Index> due_;              // bodies that something is done for
  std::vector<Task> tasks_;
  std::vector<Thread> threads_;
  Candidates current_, previous_;
  std::size_t work_ = 0;
};

}  // namespace collide::surface
