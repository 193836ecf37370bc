#pragma once
// The inner loops of a substep over one batch of bodies, chosen for its width and for the processor at hand. Every
// variant is compiled from the same source without fused arithmetic, so all give the same bits.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

#include "softbody/isa.h"
#include "softbody/lanes.h"
#include "softbody/solid_shapes.h"

namespace softbody {

/// A spring as the loops want it: particle indices already times the width of the batch, single precision.
template <class Real>
struct KernelSpring {
  std::uint32_t i, j;
  Real rest, stiffness, damping;
};
template <class Real>
using KernelSpringsOf = std::vector<KernelSpring<Real>>;
using KernelSprings = KernelSpringsOf<float>;

/// Corners of a face, already times the width of the batch.
using KernelTriangle = std::array<std::uint32_t, 3>;

/// A particle's place in the shape that a body keeps, from the mean of all; see shape_matching.h.
template <class Real>
struct ShapePoint {
  Real x, y, z;
};

// Of what stands here for each lane, one that is solved by itself has but the first value.

/// Of each lane's body: the mean of x, and the sum of x q^T, q the places of ShapePoint; column c of the matrix at 3 c.
template <class Real>
struct ShapeMoments {
  alignas(64) Real mean[3][lanes], covariance[9][lanes];
};

/// Where the shape is to go: x = centre + rotation q; column c of the rotation at 3 c.
template <class Real>
struct ShapePose {
  alignas(64) Real centre[3][lanes], rotation[9][lanes];
};

struct LaneVector {
  alignas(32) float x[lanes], y[lanes], z[lanes];
};
struct DoubleLaneVector {
  alignas(64) double x[lanes], y[lanes], z[lanes];
};

struct KickArguments {
  std::size_t particles;
  float h_over_mass;   // s/kg
  float gx, gy, gz;    // h * gravity, m/s
  const float* moves;  // a value a lane, 0 or 1
};

struct ProjectArguments {
  float h;             // s
  float inverse_mass;  // 1/kg, of a particle
  const float* moves;  // a value a lane, 0 or 1
};

/// A particle that meets a solid more slowly is not thrown back, so that resting contacts rest.
inline constexpr float impact_speed = 0.5f;  // m/s

/// A solid seen from each body's own origin.
struct SolidArguments {
  std::size_t particles;
  float mass;  // kg, of one particle
  float friction, restitution;
  SolidShape<float> shape;  // grown by the thickness that particles keep from it
  LaneVector place;         // m, see the shape
  const float* moves;
  Field<float> impulse;         // N s, a value a lane: the normal impulses are added here ...
  float* returned;              // ... and here their sizes times the restitution
  float h = 0;                  // s
  float slack = 0;              // m/s: a smaller change of normal velocity is left undone
  Field<const float> before{};  // velocities at the start of the step; read only if there is restitution
};

/// Of a matrix A with P A P^T = L L^T: L by runs of columns whose entries below the run lie in the same rows, each run
/// a dense block, so that nothing is looked up for each entry.
struct CholeskyFactor {
  struct Run {
    std::uint32_t first, columns;  // the unknowns first, first + 1, ...
    std::uint32_t below, rows;     // its rows below it: so many, from row[below] on
    std::size_t value;             // its entries: (columns + rows) rows of `columns` each, from value[value] on
  };
  std::vector<std::uint32_t> place;  // of unknown i in the factor's order
  std::vector<Run> runs;
  std::vector<std::uint32_t> row;
  std::vector<double> value;  // of the diagonal the inverse
};

/// Of a body a lane.
struct Extent {
  LaneVector lo, hi;                 // corners of the box round one field's vectors
  alignas(32) float length2[lanes];  // squared length of the longest vector of another

  double longest() const { return std::sqrt(double(*std::max_element(std::begin(length2), std::end(length2)))); }
  double widest() const {  // of the boxes' diagonals
    double most = 0;
    for (int l = 0; l < lanes; ++l)
      most =
          std::max(most, std::hypot(double(hi.x[l] - lo.x[l]), double(hi.y[l] - lo.y[l]), double(hi.z[l] - lo.z[l])));
    return most;
  }
};

/// Of a lane's body: sums over its particles, with their places r seen from the first one.
struct RigidSums {
  DoubleLaneVector place, velocity;
  DoubleLaneVector momentum;       // r x v
  DoubleLaneVector square, mixed;  // of r: xx, yy, zz and yz, zx, xy
};

/// What is added to the velocities of the lanes in which `acts` is 1: push + spin x (r - about), r as in RigidSums.
struct RigidChange {
  alignas(32) float acts[lanes];       // 0 or 1
  DoubleLaneVector push, spin, about;  // m/s, rad/s, m
};

/// For batches of one width.
struct Kernels {
  void (*springs)(std::span<const KernelSpring<float>>, Field<const float> x, Field<const float> v, Field<float> f);
  void (*project_springs)(const ProjectArguments&, std::span<const KernelSpring<float>>, Field<const float> x,
                          Field<float> d);
  void (*volume)(std::span<const KernelTriangle>, Field<const float> x, float* volume);
  void (*medians)(std::span<const KernelTriangle>, Field<const float> x, float* largest);
  void (*stretch)(std::span<const KernelSpring<float>>, Field<const float> a, float* sum);
  void (*square_sum)(std::size_t particles, Field<const float> a, float* sum);
  void (*pressure)(std::span<const KernelTriangle>, Field<const float> x, const float* gauge_pressure, Field<float> f);
  void (*shape_moments)(std::span<const ShapePoint<float>>, Field<const float> x, ShapeMoments<float>&);
  void (*shape_pull)(std::span<const ShapePoint<float>>, const ShapePose<float>&, float stiffness, Field<const float> x,
                     Field<float> f);
  void (*kick)(const KickArguments&, Field<const float> f, Field<float> v);
  unsigned (*solid)(const SolidArguments&, Field<const float> x, Field<float> v);  // the lanes it acted in, as bits
  void (*drift)(std::size_t particles, float h, const float* moves, Field<const float> v, Field<float> x);
  void (*extent)(std::size_t particles, Field<const float> boxed, Field<const float> measured, Extent&);
  void (*rigid_sums)(std::size_t particles, Field<const float> x, Field<const float> v, RigidSums&);
  void (*add_rigid)(std::size_t particles, const RigidChange&, Field<const float> x, Field<float> v);
};

/// For implicit steps of eight bodies, in double; see implicit_kernels.h.
struct ImplicitKernels {
  void (*springs)(std::span<const KernelSpring<double>>, double inverse_h, Field<const double> x,
                  Field<const double> from, Field<double> f);
  void (*volume)(std::span<const KernelTriangle>, Field<const double> x, double* volume);
  void (*pressure)(std::span<const KernelTriangle>, Field<const double> x, const double* gauge_pressure,
                   Field<double> f);
  void (*substitute)(const CholeskyFactor&, double* x, double* room);
  void (*turn)(std::size_t particles, const double (*rotation)[lanes], bool back, Field<double> v);
  void (*inner_product)(std::size_t count, const double* a, const double* b, double* result);
  void (*inner_product_shared)(std::size_t count, const double* shared, const double* b, double* result);
  void (*add_scaled)(std::size_t count, const double* times, const double* a, double* y);
  void (*add_scaled_shared)(std::size_t count, const double* times, const double* shared, double* y);
};

const Kernels& kernels(Isa isa, int width = lanes);
const ImplicitKernels& implicit_kernels(Isa isa);

}  // namespace softbody
