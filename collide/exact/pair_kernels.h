#pragma once
// The loops over the vertices of two bodies, or over pairs of one, in the widest instructions of the processor (chosen
// at run time). Which contacts come out is the same on all of them: distances by squared_distance(), never fused.

#include <vector>

#include "collide/core/detector.h"
#include "collide/core/vertex_run.h"

namespace collide::exact {

/// Vertices picked out of a body, with their numbers in the frame; padded with NaN, which is near nothing.
class Picked {
 public:
  static constexpr Index padding = most_lanes;
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
  void end();  // writes the padding
  /// All vertices of a run, whose first has the number `first`.
  void take(const Run& run, Index first);
};

/// Two vertices a and b in contact satisfy dot(normal, b) - dot(normal, a) <= reach, rounding included.
struct Slab {
  glm::vec3 normal;
  float reach;
};

/// Bits that say which vertices are close: memory of the functions below.
using Words = std::vector<std::uint64_t>;

/// Memory of face(), and what it has picked if that was too much for it.
struct FacingScratch {
  Picked near_a, near_b;
  std::vector<float> along_a;
  std::vector<Index> list;
  Words words;

  void reserve(Index size_a, Index size_b);
};

/// What face() has come to.
struct Facing {
  std::uint64_t tests = 0;  // pairs that face each other; 0: a plane parts the two bodies
  bool done = true;         // if not, near_a and near_b of the scratch hold the vertices to test
};

/// Of two bodies, takes the vertices that the slab cannot part from all of the other body's, both in order, and appends
/// their contacts, ascending; or leaves them in the scratch if that takes more than most_tests.
Facing face(const Run& a, Index first_a, const Run& b, Index first_b, const Slab& slab, float tolerance2,
            std::uint64_t most_tests, FacingScratch& scratch, std::vector<Contact>& contacts);

/// Throws the std::length_error of a frame with more contacts than that.
[[noreturn]] void throw_too_many_contacts(std::size_t most);

/// Which pairs of one body's vertices can never be contacts; without a shape, none.
struct Exclusion {
  const Shape* shape = nullptr;
  Index first = 0;  // the number of the body's first vertex
  float tolerance2 = 0;

  bool operator()(Index a, Index b) const { return shape && shape->excludes(a - first, b - first, tolerance2); }
};

/// Appends every pair (a, b) with squared_distance < tolerance2 as it stands that is not excluded, ascending if both
/// are. Throws std::length_error once there are more than `most` pairs.
void contacts_between(const Picked& a, const Picked& b, float tolerance2, std::size_t most, Words& words,
                      std::vector<Contact>& contacts, const Exclusion& excluded = {});
/// The same for all pairs of one set, i before j.
void contacts_within(const Picked& set, float tolerance2, std::size_t most, Words& words,
                     std::vector<Contact>& contacts, const Exclusion& excluded = {});
/// The same for all pairs of vertex i of a run, whose first has the number `first`, with another.
void contacts_of(const Run& run, Index first, Index i, float tolerance2, Words& words, std::vector<Contact>& contacts);

}  // namespace collide::exact
