#pragma once
// Springs, and what the materials of bodies say of them. spring_law.h has their law.

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "softbody/forces/coordinates.h"
#include "softbody/model/body_model.h"

namespace softbody {

/// A spring with a damper along it.
template <class Real>
struct SpringOf {
  Index i, j;
  Real rest;       // m
  Real stiffness;  // N/m
  Real damping;    // N s/m, along the spring

  SpringOf<float> rounded() const { return {i, j, float(rest), float(stiffness), float(damping)}; }
};
using Spring = SpringOf<double>;

/// The limits of a material's springs. Stiffness and damping are stated as for the mesh of Mesh::stated_for vertices,
/// damping as a share of the critical damping of a spring k between two particles m of it: c = 2 zeta sqrt(k m / 2).
/// Each spring has the same share of both (Mesh::edge_shares), so that meshes of all resolutions stretch, bend and come
/// to rest alike.
inline constexpr Key::Limits spring_stiffness{0, 1e9}, spring_damping_ratio{0, 10};

/// What the three kinds of springs share.
struct Springs {
  static constexpr bool internal = true;
  static constexpr auto coordinate = Coordinate::length;
  static constexpr const char* absent = "no body has such springs";

  using Data = ElementList<SpringOf>;

 protected:
  /// shares: of each pair, or of none if all are 1.
  static std::optional<Data> join(const BodyModel& model, const std::vector<Edge>& pairs,
                                  const std::vector<double>& shares, double stiffness, double damping_ratio);
};

/// Springs that join these pairs of a mesh's vertices, with the values of the keys of their kind.
template <class Kind, std::vector<Edge> Mesh::*pairs, std::vector<double> Mesh::*shares>
struct SpringsAlong : Springs {
  static std::optional<Data> make(const BodyModel& m, const MeshSource&) {
    return join(m, m.mesh.*pairs, m.mesh.*shares, m.material[Kind::stiffness], m.material[Kind::damping_ratio]);
  }
};

/// Along the edges of the mesh.
struct StructuralSprings : SpringsAlong<StructuralSprings, &Mesh::edges, &Mesh::edge_shares> {
  static constexpr std::string_view key = "structural-springs";
  static constexpr auto stiffness =
      Key("structural.stiffness", "N/m", 300, spring_stiffness, "Stiffness of the springs along the edges of the mesh.",
          {"Springs", "%.0f N/m", 10, 3000, true});
  static constexpr auto damping_ratio =
      Key("structural.damping_ratio", "", 0.1, spring_damping_ratio,
          "Damping of the structural springs. 1 is critical damping.", {"  damping", "%.2f", 0, 1});
  static constexpr std::array keys{&stiffness, &damping_ratio};
};

/// Across an edge; on grids over one particle.
struct BendSprings : SpringsAlong<BendSprings, &Mesh::bend_pairs, &Mesh::bend_shares> {
  static constexpr std::string_view key = "bend-springs";
  static constexpr auto stiffness = Key("bend.stiffness", "N/m", 75, spring_stiffness,
                                        "Stiffness of the springs between the two vertices opposite an edge, on grids "
                                        "over one vertex; in finer meshes between vertices as far apart. They resist "
                                        "folding.",
                                        {"Bend springs", "%.1f N/m", 0, 1000, true});
  static constexpr auto damping_ratio =
      Key("bend.damping_ratio", "", 0.1, spring_damping_ratio, "Damping of the bend springs.");
  static constexpr std::array keys{&stiffness, &damping_ratio};
};

/// Both diagonals of each quad of a grid.
struct ShearSprings : SpringsAlong<ShearSprings, &Mesh::shear_pairs, &Mesh::shear_shares> {
  static constexpr std::string_view key = "shear-springs";
  static constexpr auto stiffness = Key("shear.stiffness", "N/m", 0, spring_stiffness,
                                        "Stiffness of the diagonal springs of grids. Other meshes have none.",
                                        {"Shear springs", "%.0f N/m", 0, 1000, true});
  static constexpr auto damping_ratio =
      Key("shear.damping_ratio", "", 0, spring_damping_ratio, "Damping of the shear springs.");
  static constexpr std::array keys{&stiffness, &damping_ratio};
};

/// Returns the springs of one kind.
template <class Kind>
const std::vector<Spring>& springs(const BodyModel& model);

/// Calls use(spring) for all springs of a model.
void for_each_spring(const BodyModel& model, const std::function<void(const Spring&)>& use);

}  // namespace softbody
