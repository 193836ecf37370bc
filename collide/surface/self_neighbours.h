#pragma once
// Keeps the pairs of features of one body that are near each other, in a reference shape: a Verlet list (Verlet 1967)
// in a frame that moves and turns with the body. So rigid motion costs nothing; only deformation uses the margin up.
// Where it has, those vertices take their present places in the reference shape, and only their pairs are searched.
//
// Proof that no pair is missing. Let X_i be the reference shape, x_i the present one, and d_i = |x_i - (c + R X_i)|,
// for any rotation R and any c. The points of a feature are means of its corners with fixed weights, so that they
// deviate by at most the largest d_i of its corners. Therefore features that are r apart now are at most r plus the
// deviations of both apart in the reference shape. Each feature has a room, which is at least r / 2 plus its deviation,
// and all pairs are listed that are no farther apart in the reference shape than their rooms.

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <span>
#include <vector>

#include "collide/core/vertex_run.h"
#include "collide/surface/box_pairs.h"
#include "collide/surface/feature_batch.h"
#include "collide/surface/surface.h"

namespace collide::surface {

class SelfNeighbours {
 public:
  /// What a search computes with.
  struct Scratch {
    BoxPairs search;
    std::vector<ItemPair> found;  // features that may be near each other
    std::vector<float> deviations;
    FeatureBatch batch;
    BoxList vertices, features, strayed_vertices, calm_vertices, strayed, calm;
  };

  /// Asks for the pairs of features that come within `near` (m) while each vertex goes its way (m), beside the rigid
  /// motion of the body. What has no room for that any more will be searched, with a margin (m), which is larger for
  /// what goes far. Vertices must be finite, and the surface must stay alive until the next call.
  void cover(const Surface& surface, const VertexRun& at, float near, std::span<const float> ways, float margin,
             Scratch& scratch);
  /// Append to scratch.found the pairs that cover() has asked for, in no particular order: perhaps others, too. Pairs
  /// that share a vertex are left out. Two threads may call one each. Throw std::length_error if more than max_pairs
  /// boxes overlap.
  void add_vertex_faces(std::size_t max_pairs, Scratch& scratch);
  void add_edges(std::size_t max_pairs, Scratch& scratch);
  /// Returns for how many vertices the last cover() wants a search.
  Index searched() const { return searched_; }

 private:
  struct Near {
    Index a, b;
    float distance;  // m, in the reference shape
  };
  struct List {
    std::vector<Near> near;
    Index first_a = 0, first_b = 0;  // the numbers of the first features of both kinds
    bool due = false;                // the pairs of what strays are to be listed anew
  };

  void take_reference(const VertexRun& at);
  void bound_rounding();
  void fit_rotation(const VertexRun& at);
  void measure_needs(const VertexRun& at, float near, std::span<const float> ways, float margin, Scratch& scratch);
  template <std::size_t n>
  void divide_features(const std::vector<std::array<Index, n>>& features, Index first, Scratch& scratch) const;
  template <PairKind kind>
  void keep_near(List& list, Scratch& scratch);
  void add_needed(const List& list, Scratch& scratch) const;
  template <class Corners>
  bool strays(const Corners& corners) const;
  template <class Visit>
  void for_each_feature(const Visit& visit) const;

  const Surface* surface_ = nullptr;
  std::vector<glm::vec3> reference_;            // m, about its centre
  std::vector<char> strayed_;                   // of each vertex: its pairs are to be listed anew
  glm::mat3 inverse_inertia_{1.0f};             // 1/m^2, of the reference shape
  glm::vec3 centre_{0.0f};                      // m, of the last shape
  glm::quat rotation_ = glm::quat(1, 0, 0, 0);  // from the reference shape to the last one
  std::vector<float> need_, margin_, room_;     // m, of each feature: vertices, faces, edges
  float rounding_ = 0;                          // m, of distances in the reference shape
  Index searched_ = 0;
  List vertex_faces_, edges_;
};

}  // namespace collide::surface
