#pragma once
// Candidates for the contact of surfaces: which vertices and faces, and which edges and edges, can come within reach of
// each other while bodies move on for a while. The same stages as the exact detector: boxes per body, bodies whose
// boxes are near, midpoint cuts of the area where two of them overlap (§2.1, §5); what is boxed here is features, swept
// over their motion, so that nothing fast slips through.
//
// Why nothing is lost, as long as no vertex strays from its straight path x + v t by more than its body's slack (see
// holds()): seen from the frame of reference that moves with body b's mean velocity u_b, a vertex of body a stays
// within the box spanned by 0 and (v - u_a) T, plus that spanned by 0 and (u_a - u_b) T, around x, grown by the slack.
// Boxes are grown by the body's skin instead, so that features that come within the sum of their bodies' (skin - slack)
// of each other have boxes that overlap: they are candidates.
//   Within a body, let v_i = u + w x r_i + s_i for any u and w. Then |x_i + v_i t - x_j - v_j t| >= |(1 + t [w]) (r_i -
// r_j)| - t |s_i| - t |s_j|, and the first is at least |r_i - r_j|, since w x r is normal to r: turning brings nothing
// closer. Turned back by 1 + t [w], the strain s t is off by t |w| times itself at most: boxes swept over s T and grown
// by that and the skin overlap if the features come within reach.

#include <span>
#include <utility>
#include <vector>

#include "collide/box_pairs.h"
#include "collide/closest_features.h"
#include "collide/workers.h"

namespace collide {

/// What moves, seen at one instant: one value a vertex, over all bodies.
struct Motion {
  Frame positions;                    // m
  std::span<const float> vx, vy, vz;  // m/s
};

struct SurfaceBody {
  const Surface* surface = nullptr;
  float skin = 0;      // m: reach and slack
  float slack = 0;     // m
  float edge = 0;      // m, the mean at rest
  bool moves = false;  // pairs of which neither does are left out
};

/// Two features by their local numbers.
struct FeaturePair {
  Index a, b;
  float from;  // s after find(): before that they cannot be within reach (and a tenth more) of each other
  auto key() const { return std::pair(a, b); }
};

/// The candidates of two bodies, or of one with itself (a == b), as places in SurfaceSearch::features().
struct SurfacePair {
  Index a, b;                 // a <= b
  std::uint32_t vertex_face;  // vertex of a, face of b: from here
  std::uint32_t face_vertex;  // vertex of b, face of a; none if a == b
  std::uint32_t edge_edge;    // edge of a, edge of b (the greater second if a == b)
  std::uint32_t end;
};

class SurfaceSearch {
 public:
  /// Finds all candidates of the coming `seconds`, bodies ascending and features ascending within their range. Bodies
  /// that are not finite are left out. self: also within bodies. Throws std::length_error beyond most_features.
  void find(const Motion& motion, std::span<const SurfaceBody> bodies, float seconds, bool self, Workers& workers);
  void clear();

  const std::vector<SurfacePair>& pairs() const { return pairs_; }
  const std::vector<FeaturePair>& features() const { return features_; }
  std::uint64_t unfolded() const { return unfolded_; }  // bodies that cannot touch themselves: no self pass
  /// Puts features() and stray() of an earlier search back, one stray a body; pairs() are none until the next find().
  void recall(std::vector<FeaturePair> features, std::span<const float> strays);

  /// Whether the candidates are still complete `elapsed` seconds after find(), with the bodies where they are now.
  bool holds(const Frame& now, float elapsed);
  /// m: how far a vertex of a body has strayed from its straight path, at the most in any holds() since find().
  float stray(Index body) const { return swept_[body].stray; }

  /// m/s: a bound of the relative speed of a pair's vertices during the motion that was foreseen.
  float speed(const SurfacePair& pair) const;
  /// Where a body's vertices were seen by find().
  Run run(Index body) const;

  static constexpr std::size_t most_features = std::size_t{1} << 27;

 private:
  struct Swept {
    bool live = false;
    glm::vec3 velocity{0.0f};  // mean, m/s
    float spread = 0;          // m: how far a vertex may get from where the mean velocity takes it
    float strain = 0;          // m: the same from where the body's rigid motion takes it
    glm::vec3 centre{0.0f};    // m
    glm::vec3 spin{0.0f};      // 1/s, about the centre
    float stray = 0;           // m
    Aabb box;                  // of all its vertices, seen from the body
    Aabb world;                // the same seen from the world
    BoxList vertices, faces, edges;
  };
  struct alignas(64) Thread {
    BoxPairs search;
    BoxList vertices_a, faces_a, edges_a, vertices_b, faces_b, edges_b;
    BoxList vertices, faces, edges;  // of one body at rest
    std::vector<SurfacePair> pairs;
    std::vector<ItemPair> found;
    std::vector<FeaturePair> features;
    std::uint64_t unfolded = 0;
  };
  void sweep_body(Index body);
  void find_pair(Thread& own, SurfacePair& pair);
  void find_self(Thread& own, SurfacePair& pair);
  /// Of two features: how far apart, m^2, and how fast their corners pass each other, (m/s)^2.
  struct Meeting {
    float distance2, speed2;
  };
  Meeting vertex_face(Index a, Index vertex, Index b, const Triangle& face) const;
  Meeting edge_edge(Index a, const Edge& one, Index b, const Edge& two) const;
  template <std::size_t n, std::size_t m>
  float fastest(Index a, const std::array<Index, n>& one, Index b, const std::array<Index, m>& two) const;
  template <class Meet>
  void keep(Thread& own, const SurfacePair& pair, const Meet& meet);
  glm::vec3 at(Index body, Index v) const;
  glm::vec3 velocity(Index body, Index v) const;
  glm::vec3 strain_velocity(Index body, Index v) const;
  void gather();
  bool star_shaped(Index body) const;
  void find_near();

  Motion motion_{};
  std::span<const SurfaceBody> bodies_;
  float seconds_ = 0;
  std::array<std::vector<float>, 3> start_, velocity_;
  std::vector<Swept> swept_;
  std::vector<Index> order_;
  std::vector<ItemPair> near_;  // bodies; a == b: with itself
  std::vector<char> needed_;
  std::vector<Thread> threads_;
  std::vector<SurfacePair> pairs_;
  std::vector<FeaturePair> features_;
  std::uint64_t unfolded_ = 0;
};

}  // namespace collide
