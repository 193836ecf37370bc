#pragma once
// The inner loops of the exact method over pairs of vertices. Vectorised with Highway, which chooses the processor's
// instruction set at run time. Every instruction set finds the same contacts: distances are those of
// squared_distance(), never fused.

#include <vector>

#include "collide/core/detector.h"
#include "collide/core/vertex_run.h"

namespace collide::exact {

/// Some vertices of a body with their numbers in the frame. The coordinates are padded with NaN, which is close to
/// nothing, so that whole vectors can be read at the end.
class VertexSet {
 public:
  static constexpr Index padding = max_lanes;
  std::vector<float> x, y, z;
  std::vector<Index> vertex;
  Index size = 0;

  void reserve(Index count);
  void add(float px, float py, float pz, Index v) {
    x[size] = px;
    y[size] = py;
    z[size] = pz;
    vertex[size++] = v;
  }
  void end();  // writes the padding; call it after the last add()
  /// Takes all vertices of a run whose first vertex has the number `first`.
  void take(const VertexRun& run, Index first);
};

/// A test along the line of centres of two bodies: vertices a and b in contact satisfy
/// dot(normal, b) - dot(normal, a) <= cutoff, rounding included.
struct Slab {
  glm::vec3 normal;  // of length 1, rounded
  float cutoff;      // m
};

/// Scratch memory of the functions below: one bit for each pair, set if the pair is close.
using Words = std::vector<std::uint64_t>;

/// Scratch memory of find_facing_contacts(), and its result where it stopped early.
struct FacingScratch {
  VertexSet near_a, near_b;
  std::vector<float> along_a;
  std::vector<Index> list;
  Words words;

  void reserve(Index size_a, Index size_b);
};

struct FacingResult {
  std::uint64_t tests = 0;  // how many pairs of vertices face each other; 0: a plane separates the two bodies
  bool done = true;         // false: near_a and near_b of the scratch hold the vertices that must still be tested
};

/// Selects the vertices of two bodies that the slab does not separate from all vertices of the other body, and appends
/// the contacts among them; ascending. If that takes more than max_tests tests, only selects them.
FacingResult find_facing_contacts(const VertexRun& a, Index first_a, const VertexRun& b, Index first_b,
                                  const Slab& slab, float tolerance2, std::uint64_t max_tests, FacingScratch& scratch,
                                  std::vector<Contact>& contacts);

/// Appends every pair of a vertex of a and a vertex of b, in this order, whose squared_distance() is below tolerance2.
/// The pairs are sorted if both sets are. Throws std::length_error if `contacts` grows beyond `max_contacts`.
void contacts_between(const VertexSet& a, const VertexSet& b, float tolerance2, std::size_t max_contacts, Words& words,
                      std::vector<Contact>& contacts);
/// Does the same, without a limit, for all pairs of vertex i of a run with another vertex of it. first: the number of
/// the run's first vertex.
void contacts_of(const VertexRun& run, Index first, Index i, float tolerance2, Words& words,
                 std::vector<Contact>& contacts);

}  // namespace collide::exact
