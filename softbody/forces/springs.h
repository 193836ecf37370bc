#pragma once
// Springs: Hooke's law with a damper along the spring.

#include <array>

#include "softbody/model/key.h"

namespace softbody {

/// The limits of a material's springs. Damping is stated as a share of the critical damping of a spring between its two
/// particles: c = 2 zeta sqrt(k m / 2).
inline constexpr Key::Limits spring_stiffness{0, 1e9}, spring_damping_ratio{0, 10};

/// Along the edges of the mesh.
struct StructuralSprings {
  static constexpr auto stiffness =
      Key("structural.stiffness", "N/m", 300, spring_stiffness, "Stiffness of the springs along the edges of the mesh.",
          {"Springs", "%.0f N/m", 10, 3000, true});
  static constexpr auto damping_ratio =
      Key("structural.damping_ratio", "", 0.1, spring_damping_ratio,
          "Damping of the structural springs. 1 is critical damping.", {"  damping", "%.2f", 0, 1});
  static constexpr std::array keys{&stiffness, &damping_ratio};
};

/// Between the two vertices opposite an edge; on grids over one particle.
struct BendSprings {
  static constexpr auto stiffness = Key("bend.stiffness", "N/m", 75, spring_stiffness,
                                        "Stiffness of the springs between the two vertices opposite an edge, on grids "
                                        "over one vertex. They resist folding.",
                                        {"Bend springs", "%.1f N/m", 0, 1000, true});
  static constexpr auto damping_ratio =
      Key("bend.damping_ratio", "", 0.1, spring_damping_ratio, "Damping of the bend springs.");
  static constexpr std::array keys{&stiffness, &damping_ratio};
};

/// Both diagonals of each quad of a grid.
struct ShearSprings {
  static constexpr auto stiffness = Key("shear.stiffness", "N/m", 0, spring_stiffness,
                                        "Stiffness of the diagonal springs of grids. Other meshes have none.",
                                        {"Shear springs", "%.0f N/m", 0, 1000, true});
  static constexpr auto damping_ratio =
      Key("shear.damping_ratio", "", 0, spring_damping_ratio, "Damping of the shear springs.");
  static constexpr std::array keys{&stiffness, &damping_ratio};
};

}  // namespace softbody
