#pragma once
// A body model is all that bodies of one mesh and one material share. Bodies of one model are solved together.

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
  double rest_volume = 0;  // V0 in m^3: below 0.1 V0 the law goes on linearly

  // All at volume v, which may be zero or negative (an inverted body).
  /// Absolute pressure in Pa.
  double pressure(double v) const;
  /// Ambient pressure in Pa. It acts on the outer side of the skin: within 0.1 V0 of a flat body it changes its sign.
  /// Otherwise an inverted body with little gas would be blown up without end.
  double ambient_pressure(double v) const;
  /// The pressure in Pa that drives the faces out.
  double gauge(double v) const { return pressure(v) - ambient_pressure(v); }
  /// The derivative of gauge() in Pa/m^3, never positive.
  double slope(double v) const;
  /// Work done against the ambient pressure in J, 0 at V0; d/dV = ambient_pressure().
  double ambient_energy(double v) const;
  /// That work less the work done by the gas, in J, 0 at V0; d/dV = -gauge().
  double energy(double v) const;
};

struct BodyModel {
  Mesh mesh;
  Material material;
  std::shared_ptr<const collide::Shape> shape;               // what the detectors see of it
  std::shared_ptr<const collide::surface::Surface> surface;  // for contact of the true surfaces
  double mean_edge = 0;                                      // m, at rest
  std::vector<Spring> structural, bend, shear;
  Gas gas;
  std::vector<Index> first_face{0}, face;  // the triangles at each vertex, one list after another
  bool has_gas = false;                    // closed, and some pressure acts on it
  double shape_rate = 0;                   // 1/s, the w of shape_matching.h; 0: the body does not keep its shape
  std::vector<glm::dvec3> goal;            // m, the mesh seen from its vertices' mean; empty if shape_rate is 0
  double particle_mass = 0;                // kg
  double radius = 0;                       // m, bounding radius of the mesh
  std::vector<glm::dvec3> start;           // starting shape: the equilibrium, or the mesh itself
  double start_volume = 0;                 // m^3, 0 for open meshes
  // Of the springs in stable_step(): half of the largest eigenvalues of their matrices (see spring_bound()).
  double spring_stiffness_bound = 0;  // N/m: at most the largest sum of the stiffnesses at one particle
  double spring_damping_bound = 0;    // N s/m
  double largest_degree = 0;          // faces at one particle

  std::span<const Index> faces_of(Index vertex) const {
    return std::span(face).subspan(first_face[vertex], first_face[vertex + 1] - first_face[vertex]);
  }
};

/// Returns a body model whose starting shape is the mesh itself, in balance or not.
std::shared_ptr<BodyModel> make_unbalanced_body_model(const MeshSource& mesh, const Material& material);

/// Returns a body model of the same mesh with another material. It keeps the starting shape, which is in equilibrium
/// only for the material that it was found for. `source`: that of the mesh.
std::shared_ptr<const BodyModel> with_material(const BodyModel& model, const MeshSource& source,
                                               const Material& material);

/// What the stability bound of the gas needs to know of a body's shape.
struct SurfaceShape {
  double volume = 0;       // m^3
  double area2 = 0;        // m^4: the sum over the particles of |A|^2, A = dV/dx
  double stretch = 0;      // N m^3: the sum over the springs of the stiffness times |A_i - A_j|^2
  double two_medians = 0;  // m: the largest sum of a face's two longest medians
};
SurfaceShape measure_surface(const BodyModel& model, const std::vector<glm::dvec3>& vertices);

/// Returns a bound of the stiffness over mass (1/s^2) of springs, gas and shape matching at one particle of a body of
/// this shape.
double stiffness_per_mass(const BodyModel& model, const SurfaceShape& surface);

/// Returns 0.8 times the largest stable step of semi-implicit Euler in s, for the sums k_m of stiffness/mass (1/s^2)
/// and c_m of damping/mass (1/s) at one particle: omega^2 <= 2 k_m, h = 0.8 (2/omega)(sqrt(1 + z^2) - z), z = 2 c_m /
/// (2 omega).
double stable_step(double k_m, double c_m);

}  // namespace softbody
