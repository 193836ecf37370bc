#pragma once
// What a body is made of.

#include <optional>
#include <string>

namespace softbody {

/// A linear spring law with a damper along the spring (Introduction of the paper: elasticity and damper).
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
  double internal_damping = 0;  // 1/s, rate at which a body's motion becomes rigid
  double rebound_speed = 0;  // m/s: solids throw a body back no faster than this or their restitution does; 0: no limit
  double thickness = 0.005;  // m: particles keep this far from solids, so that the faces between them stay outside
  double friction = 0.5;     // Coulomb, against other bodies
  double restitution = 0;    // 0..1, Newton's, of surface contact between bodies
  double rolling_resistance = 0.02;  // torque = this * radius * normal force, against solids
  double contact_stiffness = 100;    // N/m of penalty contact, summed over one particle's contacts
  /// Hz with which a lone particle swings about its place in the mesh's own shape (shape_matching.h); 0: springs and
  /// gas alone. Not given: mesh_file_shape_frequency for meshes from files, 0 for others.
  std::optional<double> shape_frequency;
  bool start_in_equilibrium = true;  // springs and gas are brought into balance when the scene is loaded
  bool operator==(const Material&) const = default;
};

inline constexpr double mesh_file_shape_frequency = 10;  // Hz

}  // namespace softbody
