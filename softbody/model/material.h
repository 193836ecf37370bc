#pragma once
// Material of a body.

#include <optional>
#include <string>

namespace softbody {

/// Linear spring with a damper along it (the paper's Introduction: elasticity and damper).
struct SpringLaw {
  double stiffness = 0;  // N/m
  double damping_ratio =
      0;  // of the critical damping of the spring between its two particles: c = 2 zeta sqrt(k m / 2)
  bool operator==(const SpringLaw&) const = default;
};

struct Material {
  std::string name;
  double mass = 1;  // kg a body, shared equally by its particles
  SpringLaw structural{300, 0.1};
  SpringLaw bend{75, 0.1};
  SpringLaw shear{};            // quad grids only
  double gas_pressure = 0;      // Pa, absolute, of the gas at the mesh's own volume: P = gas_pressure * V0 / V
  double ambient_pressure = 0;  // Pa, absolute, outside
  double internal_damping = 0;  // 1/s, rate at which deformation velocities decay
  double rebound_speed = 0;     // m/s: a body rebounds from solids no faster, unless by their restitution; 0: no limit
  double thickness = 0.005;  // m: particles keep this distance to solids, so that the faces between them stay outside
  double friction = 0.5;     // Coulomb, against other bodies
  double restitution = 0;    // 0..1, Newton's, of surface contact between bodies
  double rolling_resistance = 0.02;  // torque = this * radius * normal force, against solids
  double contact_stiffness = 100;    // N/m of penalty contact, summed over one particle's contacts
  /// Frequency in Hz at which a single particle oscillates about its place in the mesh's shape (shape_matching.h). 0:
  /// no shape matching. Not given: mesh_file_shape_frequency for meshes from files, 0 for others.
  std::optional<double> shape_frequency;
  bool start_in_equilibrium = true;  // springs and gas are brought into balance when the scene is loaded
  bool operator==(const Material&) const = default;
};

inline constexpr double mesh_file_shape_frequency = 10;  // Hz

}  // namespace softbody
