#pragma once
// Candidates for the contact of surfaces: which vertices and faces, and which edges and edges, can come within reach of
// each other while bodies move on for a while. The same stages as the exact detector: boxes per body, bodies whose
// boxes are near, midpoint cuts of the area where two of them overlap (§2.1, §5); what is boxed here is features, swept
// over their motion, so that nothing fast slips through. A body that strays is foreseen anew, alone with its
// neighbours; all others' candidates stay.
//
// Why nothing is lost, as long as no vertex strays from its straight path x + v t by more than its body's slack (see
// holds()): seen from the frame of reference that moves with body b's mean velocity u_b, a vertex of body a stays
// within the box spanned by 0 and (v - u_a) T, plus that spanned by where a is seen from b first and last, around x,
// grown by the slack. Boxes are grown by the body's skin instead, so that features that come within the sum of their
// bodies' (skin - slack) of each other have boxes that overlap: they are candidates.
//   Within a body, let v_i = u + w x r_i + s_i for any u and w. Then |x_i + v_i t - x_j - v_j t| >= |(1 + t [w]) (r_i -
// r_j)| - t |s_i| - t |s_j|, and the first is at least |r_i - r_j|, since w x r is normal to r: turning brings nothing
// closer. Turned back by 1 + t [w], the strain s t is off by t |w| times itself at most: boxes swept over s T and grown
// by that and the skin overlap if the features come within reach.

#include <utility>
#include <vector>

#include "collide/core/workers.h"
#include "collide/surface/feature_pairs.h"
#include "collide/surface/swept_body.h"

namespace collide::surface {

/// Two features by their local numbers.
struct FeaturePair {
  Index a, b;
  float from;  // s after find(): before that they cannot be within reach (and a tenth more) of each other
  auto key() const { return std::pair(a, b); }
};

/// The candidates of two bodies, or of one with itself (a == b), as places in SurfaceSearch::features(). There may be
/// none, if one of the bodies may be wholly inside the other.
struct SurfacePair {
  Index a, b;                 // a <= b
  std::uint32_t vertex_face;  // vertex of a, face of b: from here
  std::uint32_t face_vertex;  // vertex of b, face of a; none if a == b
  std::uint32_t edge_edge;    // edge of a, edge of b (the greater second if a == b)
  std::uint32_t end;
  auto bodies() const { return std::pair(a, b); }
};

/// What is asked of a search.
struct SurfaceQuery {
  float seconds = 0;
  float least = 0;    // s: see SweptBody::foresee()
  bool self = false;  // also within bodies
  std::size_t most_features = std::size_t{1} << 24;
};

class SurfaceSearch {
 public:
  /// Finds all candidates of the coming seconds, until foreseen(), bodies ascending and features ascending within their
  /// range. Bodies that are not finite are left out. Throws std::length_error beyond what may be; nothing that was
  /// found before holds then.
  void find(const Motion& motion, std::span<const SurfaceBody> bodies, const SurfaceQuery& query, Workers& workers);
  /// `elapsed` seconds later: finds those of bodies that are due anew, for the seconds `least` in any case. bodies:
  /// theirs may have changed; motion: that of others is not looked at.
  void renew(const Motion& motion, std::span<const SurfaceBody> bodies, float elapsed, float least, Workers& workers);
  void clear();

  const std::vector<SurfacePair>& pairs() const { return now_.pairs; }
  const std::vector<FeaturePair>& features() const { return now_.features; }
  /// What the last find() or renew() took: features that were boxed, pairs of boxes that overlap, and candidates.
  std::size_t work() const { return work_; }
  /// Those before the last find() or renew().
  const std::vector<FeaturePair>& features_before() const { return before_.features; }
  /// How a body's motion bore out what was foreseen.
  struct Past {
    float stray;   // m
    float lasted;  // s, until the end of what find() was asked for
  };
  Past past(Index body) const { return {swept_[body].stray(), end_ - swept_[body].begin()}; }
  /// Puts features() and past() of an earlier search back, one a body; pairs() are none until the next find().
  void recall(std::vector<FeaturePair> features, std::span<const Past> past);

  /// Whether the candidates are still complete `elapsed` seconds after find(), with the bodies where they are now, and
  /// will be for the seconds `ahead`.
  bool holds(const Frame& now, float elapsed, float ahead = 0);
  float foreseen() const { return foreseen_; }  // s after find(): until then all bodies' motion is
  /// A body as it was foreseen last, and how far it has strayed from that, at the most in any holds() since.
  const SweptBody& body(Index body) const { return swept_[body]; }

  /// m/s: a bound of the relative speed of a pair's vertices during the motion that was foreseen.
  float speed(const SurfacePair& pair) const;

 private:
  struct Candidates {
    std::vector<SurfacePair> pairs;
    std::vector<FeaturePair> features;
  };
  struct alignas(64) Thread {
    BoxPairs search;
    BoxList vertices_a, faces_a, edges_a, vertices_b, faces_b, edges_b;
    BoxList vertices, faces, edges;  // of one body at rest
    std::vector<ItemPair> found;
    FeaturePairs meeting;
    Candidates candidates;
    std::size_t work = 0;
  };
  void search(const Motion& motion, float least, Workers& workers);
  void require_few(std::size_t features) const;
  void find_near();
  void find_candidates(Thread& own, const ItemPair& bodies);
  void find_pair(Thread& own, SurfacePair& pair) const;
  void find_self(Thread& own, SurfacePair& pair) const;
  void stay(Thread& own, SurfacePair& pair) const;
  void gather();
  void keep_vertices_on_faces(Thread& own, const SurfacePair& pair, Index vertex_body, Index face_body) const;
  void keep_edges(Thread& own, const SurfacePair& pair) const;
  template <std::size_t n, std::size_t m>
  float fastest(Index a, const std::array<Index, n>& one, Index b, const std::array<Index, m>& two) const;
  template <class Speed>
  void keep(Thread& own, const SurfacePair& pair, const Speed& speed2) const;
  glm::vec3 at(Index body, Index v) const { return swept_[body].at(v, time_); }

  std::span<const SurfaceBody> bodies_;
  SurfaceQuery query_;
  float time_ = 0, end_ = 0, foreseen_ = 0;  // s after find()
  std::vector<SweptBody> swept_;
  std::vector<char> anew_;    // bodies that are foreseen anew
  std::vector<char> needed_;  // of these, and of those near them: whose features' boxes are
  std::vector<char> boxed_;   // bodies that have them
  std::vector<Index> order_;
  std::vector<ItemPair> near_;  // bodies; a == b: with itself
  std::vector<Thread> threads_;
  Candidates now_, before_;
  std::size_t work_ = 0;
};

}  // namespace collide::surface
