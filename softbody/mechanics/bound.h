#pragma once
// The stability bound: how stiff all forces inside a body are together.

#include <span>

#include "softbody/model/body_model.h"

namespace softbody {

struct WeightedPair {
  Index i, j;
  double weight;  // N/m, or N s/m
};

/// Returns an upper bound of the largest eigenvalue of forces between pairs of `particles` particles, wherever they
/// are. A pair of stiffness k acts on its ends by no more than k times the identity, whatever its direction, so all
/// act by no more than the Laplacian of their graph. Lanczos' method finds the largest eigenvalue of the Laplacian. The
/// residual (Zhou and Li 2011, "Bounding the spectrum of large Hermitian matrices") and one per cent are added. The
/// result is never more than Gershgorin's bound, twice the largest sum of the weights at one particle.
double pair_bound(std::size_t particles, std::span<const WeightedPair> pairs);

/// Works out the bounds that ModelForces holds from its data.
void set_bounds(ModelForces& forces, std::size_t particles);

/// Properties of a body's present shape for the bound of forces that depend on the volume. A = dV/dx.
struct SurfaceShape {
  double volume = 0;       // m^3
  double area2 = 0;        // m^4: the sum over the particles of |A|^2
  double stretch = 0;      // N m^3: the sum over the pairs of the stiffness times |A_i - A_j|^2
  double two_medians = 0;  // m: of one face, the largest root of twice the sum of the squares of two medians
};
SurfaceShape measure_surface(const BodyModel& model, const std::vector<glm::dvec3>& vertices);

/// How forces that depend on the volume of a body act in a substep: as it is at its start, or in balance with its end.
enum class Volumes { explicit_, implicit_ };

/// Returns an upper bound of the stiffness over mass (1/s^2) that the forces inside a body of this shape cause at one
/// particle. Of Volumes::implicit_, without what resists a change of the volume.
double stiffness_per_mass(const BodyModel& model, const SurfaceShape& surface, Volumes volumes = Volumes::explicit_);

/// Returns the damping (N s/m) at one particle, for stable_step().
double damping_bound(const BodyModel& model);

/// Returns 0.8 times the largest stable step of semi-implicit Euler in s, for the sums k_m of stiffness/mass (1/s^2)
/// and c_m of damping/mass (1/s) at one particle: omega^2 <= 2 k_m, h = 0.8 (2/omega)(sqrt(1 + z^2) - z), z = 2 c_m /
/// (2 omega).
double stable_step(double k_m, double c_m);

}  // namespace softbody
