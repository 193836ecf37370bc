#pragma once
// Culling of self-collision: proves, frame by frame, that most vertices of a body cannot touch one another. The proof
// costs less than the test of all pairs that it saves.

#include <memory>
#include <unordered_map>

#include "collide/core/vertex_kernels.h"

namespace collide::exact {

/// The pairs of a body's vertices that must still be tested.
struct SelfCollisionCandidates {
  bool culled;                                  // false: all pairs must be tested, and the rest means nothing
  std::span<const std::array<Index, 2>> pairs;  // test these pairs, which may name outliers, too
  std::span<const Index> outliers;              // test each of these vertices with every other one; ascending
};

/// The reference positions X of a mesh, which the bodies x of that mesh are compared with.
///
/// Fit an affine map to a body: x_i = A X_i + t + e_i. Then for any two of its vertices
///     |x_i - x_j| >= s |X_i - X_j| - |e_i| - |e_j|,   s the smallest singular value of A.
/// All pairs closer than `covered` in the reference are listed once, when the reference is made. Every other pair is
/// farther apart than the cutoff, unless |e| exceeds (s covered - cutoff) / 2 for one of its two vertices: such
/// vertices are the outliers. Where a body is neither flattened nor folded, both lists are short. The body's positions
/// decide how much is left to test, never which contacts are found.
class CullingReference {
 public:
  static constexpr Index min_vertices = sample_run, max_vertices = 2048;

  /// positions: of one body. cutoff: m. The reference is usable() if it has `min_vertices` to `max_vertices` vertices,
  /// is finite and is not flat.
  CullingReference(const VertexRun& positions, const Topology& topology, float cutoff);

  bool usable() const { return usable_; }

  struct Scratch {
    std::vector<float> residual2;
    std::vector<Index> outliers;
  };
  /// Returns what must be tested of a body of this mesh. The spans point into the scratch and the reference.
  SelfCollisionCandidates candidates_of(const VertexRun& body, const BodyBounds& bound, Scratch& scratch) const;

 private:
  void list_pairs(const Topology& topology);

  bool usable_ = false;
  float cutoff_ = 0;
  std::vector<float> x_, y_, z_;             // centred
  std::array<float, 9> inverse_moment_;      // of the sum of X X^T
  float radius_ = 0;                         // m: no vertex is farther from the centre
  float covered_ = 0;                        // m: pairs_ holds all closer pairs that no edge joins
  std::vector<std::array<Index, 2>> pairs_;  // the closest first
  std::vector<float> distance_;              // of each pair
};

/// Holds a reference for each topology of a frame, if enough bodies share it: the rest shape where it is known, else
/// the first body of that topology in the frame.
class SelfCollisionCulling {
 public:
  /// Makes the missing references of the frame's live bodies and drops those that no live body needs.
  void update(const Frame& frame, std::span<const Index> live, float cutoff);
  /// Drops the references that were taken from frames. Those of rest shapes stay.
  void forget();

  /// Returns the reference of a live body, or nullptr if it has none.
  const CullingReference* of(Index body) const { return by_body_[body]->reference.get(); }

 private:
  struct Entry {
    std::shared_ptr<const Topology> topology;     // kept alive, so that no other topology can take its address
    std::unique_ptr<CullingReference> reference;  // null if no usable one could be made
    float cutoff = 0;
    bool from_frame = false;
    Index first_body = 0, bodies = 0;  // in this frame
  };
  static void make(Entry& entry, const Frame& frame, float cutoff);

  static constexpr Index vertices_a_body = 64;  // at most: the list of a reference costs the square of its vertices
  std::unordered_map<const Topology*, Entry> entries_;
  std::vector<const Entry*> by_body_;
};

}  // namespace collide::exact
