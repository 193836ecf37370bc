#pragma once
// What a method will have to do on a frame, before it does it: so that no method holds a core for long.

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "collide/core/body_boxes.h"
#include "collide/methods.h"

namespace app {

struct WorkEstimate {
  std::uint64_t pair_tests = 0, hashes = 0;

  /// In pair tests: a hash with the visit of its cell takes about as long as 32 of them.
  std::uint64_t cost() const { return pair_tests + 32 * hashes; }
  /// "1,234 million pair tests", or hash evaluations where those are what takes long.
  std::string in_words() const;
};

/// Among n things.
inline std::uint64_t pairs_of(std::uint64_t n) { return n * (n - (n > 0)) / 2; }

/// Distances that brute force evaluates on these bodies.
std::uint64_t all_pair_tests(const collide::Bodies& bodies, bool self_collision);

/// Predicts the work of every method of collide::method_table(), by its index. Exact for brute force and Bounding Box;
/// for the others what they did last with the same settings in the same world, and before that an estimate: all
/// vertices of bodies whose boxes overlap, and aliasing as if the entries were spread evenly over the buckets. A method
/// with levels and no table is taken to test some sixteen others for each vertex that it reads.
class CostModel {
 public:
  /// Another frame. `world` tells worlds apart: what was learnt in another one is forgotten.
  void begin(const collide::Frame& frame, const collide::Settings& settings, std::uint64_t world);
  WorkEstimate of(std::size_t method) const;
  /// What the method really did on this frame.
  void learn(std::size_t method, const collide::Counters& counters);

 private:
  struct Learnt {
    WorkEstimate work;
    double vertices = 0;  // 0: nothing learnt
  };
  WorkEstimate estimate(const collide::Method& method) const;
  double reachable_buckets() const;

  collide::Settings settings_;
  std::uint64_t world_ = 0;
  std::vector<Learnt> learnt_;
  double vertices_ = 0, bodies_ = 0;
  glm::dvec3 extent_{0};  // m, of all bodies
  // Pair tests: all, all between near bodies, and those of near bodies that the exact method's cuts leave.
  std::uint64_t all_ = 0, in_near_bodies_ = 0, exact_tests_ = 0;
  collide::BodyBoxes boxes_;
  collide::BodyPairs pairs_;
};

}  // namespace app
