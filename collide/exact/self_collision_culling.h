#pragma once
// When a body cannot touch itself: a proof for each frame that costs less than the self pass that it saves.

#include <memory>
#include <unordered_map>

#include "collide/core/vertex_kernels.h"

namespace collide::exact {

/// What is left to test of a body's own pairs, if not all of them.
struct SelfCollisionCandidates {
  bool proven;                                  // if not, all pairs are
  std::span<const std::array<Index, 2>> pairs;  // these (some of odd vertices, too),
  std::span<const Index> odd;                   // and each of these vertices with every other; ascending
};

/// A mesh as it was seen somewhere, whatever the frame: the shape that bodies are compared with.
///
/// Fit an affine map to a body: x_i = A X_i + t + e_i. Then for any two of its vertices
///     |x_i - x_j| >= s |X_i - X_j| - |e_i| - |e_j|,   s the smallest singular value of A.
/// All pairs closer than `covered` in the reference are listed here, once. Every other pair is farther apart than the
/// reach, unless |e| exceeds (s covered - reach) / 2 for one of its two vertices: these are the odd ones. Where a body
/// is neither flattened nor folded, both are few. The bodies' positions decide how much is left, never what is found.
class CullingReference {
 public:
  /// Positions of one body. usable() if it has neither too few nor too many vertices and is finite and not flat.
  CullingReference(const Run& positions, const Topology& topology, float reach);

  bool usable() const { return usable_; }

  struct Scratch {
    std::vector<float> residual2;
    std::vector<Index> odd;
  };
  /// The answer lives as long as the scratch and the reference are left alone.
  SelfCollisionCandidates at_risk(const Run& body, const Bound& bound, Scratch& scratch) const;

 private:
  void list_pairs(const Topology& topology);

  static constexpr Index fewest = sample_run, most = 2048;  // vertices
  bool usable_ = false;
  float reach_ = 0;
  std::vector<float> x_, y_, z_;             // centred
  std::array<float, 9> inverse_moment_;      // of the sum of X X^T
  float radius_ = 0;                         // the farthest vertex from the centre
  float covered_ = 0;                        // all pairs not joined by an edge and closer than this are listed
  std::vector<std::array<Index, 2>> pairs_;  // the closest first
  std::vector<float> distance_;              // of each pair
};

/// A reference for each topology of a frame: its shape at rest where that is known, else its first body in the frame if
/// enough bodies share it.
class SelfCollisionCulling {
 public:
  /// Makes what is missing and throws away what no live body needs any more.
  void update(const Frame& frame, std::span<const Index> live, float reach);
  /// Drops the references taken from frames; those at rest stay.
  void forget();

  /// nullptr if the body has none.
  const CullingReference* of(Index body) const { return by_body_[body]->reference.get(); }

 private:
  struct Entry {
    std::shared_ptr<const Topology> topology;     // kept, so that no other one can take its address
    std::unique_ptr<CullingReference> reference;  // if there is one of use
    float reach = 0;
    bool from_frame = false;
    Index first_body = 0, bodies = 0;  // in this frame
  };
  static void make(Entry& entry, const Frame& frame, float reach);

  static constexpr Index enough = 4;
  std::unordered_map<const Topology*, Entry> entries_;
  std::vector<const Entry*> by_body_;
};

}  // namespace collide::exact
