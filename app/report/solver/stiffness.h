#pragma once
// Whether a material is as stiff in a fine mesh as in a coarse one.

#include <string>
#include <vector>

namespace app::report {

/// A body of one mesh.
struct Stiffness {
  std::size_t particles;
  double sag;     // R: how much lower it is on the ground, at rest, than in free flight
  double period;  // s, of its slowest swing after it was stretched
};

/// A body of one shape and one material, in meshes from coarse to fine.
struct StiffnessCase {
  std::string name;
  std::vector<Stiffness> meshes;
};

/// Measures all cases. quick: without the finest meshes.
std::vector<StiffnessCase> measure_stiffness(bool quick);

}  // namespace app::report
