#pragma once
// Predicts the work of a method on a frame before it runs, so that no method occupies a core for long.

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "app/compare/pair_sample.h"
#include "collide/core/body_boxes.h"
#include "collide/methods.h"

namespace app::compare {

struct WorkEstimate {
  std::uint64_t pair_tests = 0, hashes = 0;

  /// Returns the work in pair tests. A hash and the visit of its cell take about as long as 32 of them.
  std::uint64_t cost() const { return pair_tests + 32 * hashes; }
  /// Returns e.g. "1,234 million pair tests"; hash evaluations where these take longer.
  std::string in_words() const;
};

/// Returns the number of pairs among n things.
inline std::uint64_t pairs_of(std::uint64_t n) { return n * (n - (n > 0)) / 2; }

/// Returns the number of distances that brute force evaluates on these bodies.
std::uint64_t all_pair_tests(const collide::Bodies& bodies, bool self_collision);

/// Predicts the work of each method of collide::method_table(), by its index. The prediction is exact for brute force
/// and Bounding Box. For another method it is its last measured work with the same settings in the same world. Before
/// that it is an estimate. Of methods with a hash table: the pairs that meet in the cells of the grid, by a sample of
/// all pairs, and aliasing as if the entries were spread evenly over the buckets. Of the exact method: about sixteen
/// tests for each vertex. Of the sorted methods and trees: 64 tests for each vertex, and the pairs that come within
/// about twice the tolerance.
class CostModel {
 public:
  /// Sets the frame, which must be complete. `world` differs from world to world: what was learnt in another world is
  /// forgotten.
  void begin(const collide::Frame& frame, const collide::Settings& settings, std::uint64_t world);
  /// Returns the predicted work of a method. Precondition, as of learn(): begin() was called.
  WorkEstimate of(std::size_t method) const;
  /// Tells the model what the method really did on this frame.
  void learn(std::size_t method, const collide::Counters& counters);

 private:
  struct Learnt {
    WorkEstimate work;
    double vertices = 0;  // of the frame; 0: nothing learnt
  };
  WorkEstimate estimate(const collide::Method& method) const;
  WorkEstimate estimate_hashed(const collide::Method& method) const;
  double pairs_near(const glm::dvec3& cell, const glm::dvec3& reach) const;
  double reachable_buckets() const;

  collide::Settings settings_;
  std::uint64_t world_ = 0;
  std::vector<Learnt> learnt_;
  double vertices_ = 0, bodies_ = 0;
  glm::dvec3 extent_{0};  // m, of all bodies
  glm::dvec3 side_{0};    // m, of a body's box, on average
  // Pair tests: all; of bodies whose boxes overlap; of these, those that the exact method tests.
  std::uint64_t all_ = 0, in_overlapping_boxes_ = 0, exact_tests_ = 0;
  PairSample sample_;
  collide::BodyBoxes boxes_;
  collide::BodyPairs pairs_;
};

}  // namespace app::compare
