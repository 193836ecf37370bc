#pragma once
// A body model holds everything that bodies of one mesh and one material share. Bodies of one model are solved
// together.

#include <memory>
#include <span>
#include <vector>

#include "softbody/mesh/mesh_source.h"
#include "softbody/model/material.h"

namespace collide {
class Shape;
}
namespace collide::surface {
class Surface;
}

namespace softbody {

struct Spring {
  Index i, j;
  double rest;       // m
  double stiffness;  // N/m
  double damping;    // N s/m, along the spring
};

struct Gas {
  double amount = 0;       // nRT in J: P = amount / V
  double ambient = 0;      // Pa
  double rest_volume = 0;  // V0 in m^3; below 0.1 V0 the law is continued linearly

  // The volume v may be zero or negative (an inverted body).
  /// Absolute pressure in Pa.
  double pressure(double v) const;
  /// Pressure of the surroundings on the faces, in Pa. It acts on the outer side of the skin, so it changes its sign
  /// between -0.1 V0 and 0.1 V0. Otherwise it would inflate an inverted body with little gas without end.
  double ambient_pressure(double v) const;
  /// Pressure in Pa that pushes the faces outwards.
  double gauge(double v) const { return pressure(v) - ambient_pressure(v); }
  /// Derivative of gauge() in Pa/m^3; never positive.
  double slope(double v) const;
  /// Work done against the surroundings in J, 0 at V0; d/dV = ambient_pressure().
  double ambient_energy(double v) const;
  /// Energy in J, 0 at V0: ambient_energy() minus the work done by the gas; d/dV = -gauge().
  double energy(double v) const;
};

struct BodyModel {
  Mesh mesh;
  Material material;
  std::shared_ptr<const collide::Shape> shape;               // for detectors
  std::shared_ptr<const collide::surface::Surface> surface;  // for surface contact
  double mean_edge = 0;                                      // m, at rest
  std::vector<Spring> structural, bend, shear;
  Gas gas;
  std::vector<Index> first_face{0}, face;  // triangles at each vertex, one list after another, see faces_of()
  bool has_gas = false;                    // the mesh is closed and a pressure acts on it
  double shape_rate = 0;                   // 1/s, the w of shape_matching.h; 0: no shape matching
  std::vector<glm::dvec3> goal;            // m, the mesh relative to its vertices' mean; empty if shape_rate is 0
  double particle_mass = 0;                // kg
  double radius = 0;                       // m, bounding radius of the mesh
  std::vector<glm::dvec3> start;           // starting shape: the equilibrium, or the mesh itself
  double start_volume = 0;                 // m^3, 0 for open meshes
  // Half of the largest eigenvalues of the springs' matrices (see spring_bound()), for stable_step().
  double spring_stiffness_bound = 0;  // N/m, at most the largest sum of the stiffnesses at one particle
  double spring_damping_bound = 0;    // N s/m
  double largest_degree = 0;          // largest number of faces at one particle

  /// Returns the triangles at a vertex.
  std::span<const Index> faces_of(Index vertex) const {
    return std::span(face).subspan(first_face[vertex], first_face[vertex + 1] - first_face[vertex]);
  }
};

/// Returns a body model whose starting shape is the mesh itself, whether or not that is in equilibrium.
std::shared_ptr<BodyModel> make_unbalanced_body_model(const MeshSource& mesh, const Material& material);

/// Returns a body model of the same mesh with another material. It keeps the starting shape, which is in equilibrium
/// only for the material that it was found for. `source`: the source of the model's mesh.
std::shared_ptr<const BodyModel> with_material(const BodyModel& model, const MeshSource& source,
                                               const Material& material);

/// Properties of a body's present shape for the stability bound of the gas.
struct SurfaceShape {
  double volume = 0;       // m^3
  double area2 = 0;        // m^4: the sum over the particles of |A|^2, A = dV/dx
  double stretch = 0;      // N m^3: the sum over the springs of the stiffness times |A_i - A_j|^2
  double two_medians = 0;  // m: the largest sum of two medians of one face
};
SurfaceShape measure_surface(const BodyModel& model, const std::vector<glm::dvec3>& vertices);

/// Returns an upper bound of the stiffness over mass (1/s^2) that springs, gas and shape matching cause at one particle
/// of a body of this shape.
double stiffness_per_mass(const BodyModel& model, const SurfaceShape& surface);

/// Returns 0.8 times the largest stable step of semi-implicit Euler in s, for the sums k_m of stiffness/mass (1/s^2)
/// and c_m of damping/mass (1/s) at one particle: omega^2 <= 2 k_m, h = 0.8 (2/omega)(sqrt(1 + z^2) - z), z = 2 c_m /
/// (2 omega).
double stable_step(double k_m, double c_m);

}  // namespace softbody
