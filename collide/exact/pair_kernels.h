#pragma once
// The inner loops over the vertices of small bodies. Vectorised with Highway, which chooses the processor's instruction
// set at run time. Every instruction set finds the same contacts: distances are those of squared_distance(), never
// fused.

#include <array>
#include <vector>

#include "collide/core/detector.h"
#include "collide/core/vertex_run.h"

namespace collide::exact {

/// A test along the line of centres of two bodies: vertices a and b in contact satisfy
/// dot(normal, b) - dot(normal, a) <= cutoff, rounding included.
struct Slab {
  glm::vec3 normal;  // of length 1, rounded; or 0: the slab separates nothing
  float cutoff;      // m
};

/// Scratch memory of the function below, for bodies of up to max_vertices vertices.
struct FacingScratch {
  static constexpr Index max_vertices = 2048, max_tests = 1 << 15;
  // No multiple of 4 KiB: where few are used, none of them waits for a store to another at like addresses.
  template <class T>
  using Values = std::array<T, max_vertices + 12 * max_lanes>;
  Values<float> along_a, x, y, z;  // of a; of the facing vertices of b
  Values<Index> list, vertex;
  std::array<std::uint64_t, 2 * max_tests / 64 + 2> words;  // a bit for each pair, if close
};

/// Selects the vertices of two bodies that the slab does not separate from all vertices of the other body, and appends
/// the contacts among them; ascending. Returns how many pairs of vertices face each other; 0: a plane separates the
/// bodies; more than max_tests: they are not tested.
Index find_facing_contacts(const VertexRun& a, Index first_a, const VertexRun& b, Index first_b, const Slab& slab,
                           float tolerance2, FacingScratch& scratch, std::vector<Contact>& contacts);

/// Appends every pair of vertex i of a run and another vertex of it, in this order, whose squared_distance() is below
/// tolerance2. first: the number of the run's first vertex.
void contacts_of(const VertexRun& run, Index first, Index i, float tolerance2, std::vector<Index>& scratch,
                 std::vector<Contact>& contacts);

}  // namespace collide::exact
