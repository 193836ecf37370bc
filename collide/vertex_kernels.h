#pragma once
// The loops over the vertices of one body or of two, in the widest instructions of the processor (chosen at run time).
// Which contacts come out is the same on all of them: distances by squared_distance(), never fused.

#include <array>

#include "collide/aabb.h"
#include "collide/detector.h"

namespace collide {

/// Some vertices of one body.
struct Run {
  const float *x, *y, *z;
  Index size;  // > 0
};

/// Where a body is. `radius`: m, every vertex is within it of the box's centre, rounding included.
struct Bound {
  Aabb box;
  glm::vec3 centre;
  float radius;
  float largest;  // the greatest coordinate, whatever its sign
  bool finite;    // if not, the rest means nothing
};
Bound bound_of(const Run& run);

/// Vertices picked out of a body, with their numbers in the frame; padded with NaN, which is near nothing.
class Picked {
 public:
  static constexpr Index padding = 16;  // at least as many as an instruction takes
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

/// Appends every pair (a, b) with squared_distance < tolerance2 as it stands, ascending if both are. Throws
/// std::length_error once there are more than `most` pairs.
void contacts_between(const Picked& a, const Picked& b, float tolerance2, std::size_t most, Words& words,
                      std::vector<Contact>& contacts);
/// The same for all pairs of one set, i before j; and for all pairs of its vertex i with another.
void contacts_within(const Picked& set, float tolerance2, std::size_t most, Words& words,
                     std::vector<Contact>& contacts);
void contacts_of(const Picked& set, Index i, float tolerance2, Words& words, std::vector<Contact>& contacts);

/// The vertices that an affine map is fitted to: some of them, spread over the body, are enough. Calls visit(v).
inline constexpr Index sample_run = Picked::padding;
constexpr Index sample_stride(Index size) { return size < 8 * sample_run ? sample_run : 4 * sample_run; }
template <class Visit>
void for_samples(Index size, const Visit& visit) {
  for (Index first = 0; first + sample_run <= size; first += sample_stride(size)) {
    for (Index v = first; v < first + sample_run; ++v) visit(v);
  }
}

/// An affine map of reference positions that is fitted to a body: x = matrix * X + offset + centre. The mean of the
/// reference's samples is the origin.
struct AffineFit {
  std::array<float, 9> matrix;  // by row
  std::array<float, 3> offset;
  float residual;  // m, the root of the greatest residual2
};
/// inverse_moment: 3 x 3, symmetric, by row, of the sum of X X^T over the samples. Sizes are equal, at least
/// sample_run. residual2: the squared distance of each vertex from where the map takes its reference, as computed.
AffineFit fit_affine(const Run& body, const Run& reference, const std::array<float, 9>& inverse_moment,
                     const glm::vec3& centre, std::span<float> residual2);

/// How far any vertex is from where it was, in m, rounded up: 0 if none has moved at all, infinity if some coordinate
/// is not finite now or was not.
float farthest_move(const Run& run, const Run& before);

/// Boxes in strips across one axis, in each strip ordered along another: of each box its bounds on the axes and the
/// sphere around its centre. Padded, so that blocks can be read at the end.
struct StripBoxes {
  std::array<std::vector<float>, 3> lo, hi, centre;
  std::vector<float> radius;
  int along = 0;  // within a strip lo[along] ascends
  Index size = 0;

  void resize(Index count);
};
/// Appends every box from the place `begin` on, and before `end`, that is near() box i and whose sphere is within reach
/// of its own; stops where lo[along] is out of reach. Returns how many were near(), whatever their spheres.
Index sweep_strip(const StripBoxes& boxes, Index i, Index begin, Index end, float reach, std::vector<Index>& found);

}  // namespace collide
