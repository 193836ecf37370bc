#pragma once
// Shape matching (Mueller, Heidelberger, Teschner, Gross 2005, "Meshless deformations based on shape matching") as a
// force that keeps a body's shape. It pulls each particle to the place that it would have if the body were rigid,
//
//   f_i = m w^2 (g_i - x_i),   g_i = c + R q_i,
//
// where q_i is its place at rest relative to the mean of all, c is the mean of the particles, and R is the rotation
// that brings the q_i closest to the particles. The force is the gradient of 1/2 m w^2 sum |x_i - g_i|^2, which c and R
// minimise, so it changes neither linear nor angular momentum. A maximum over rotations is convex in x, so w^2 bounds
// the stiffness over mass in every state.

#include <array>
#include <optional>

#include "softbody/forces/coordinates.h"
#include "softbody/model/body_model.h"
#include "softbody/state/lanes.h"

namespace softbody {

inline constexpr double mesh_file_shape_frequency = 10;  // Hz

/// A particle's place in the goal shape, relative to the mean of all.
template <class Real>
struct ShapePoint {
  Real x, y, z;
  ShapePoint<float> rounded() const { return {float(x), float(y), float(z)}; }
};

/// Moments of the body in each lane: the mean of x, and the sum of x q^T with the places q of ShapePoint. Column c of
/// the matrix begins at 3 c.
template <class Real>
struct ShapeMoments {
  Real mean[3][lanes], covariance[9][lanes];
};

/// Pose of the goal shape: x = centre + rotation q. Column c of the rotation begins at 3 c.
template <class Real>
struct ShapePose {
  Real centre[3][lanes], rotation[9][lanes];
};

struct ShapeMatching {
  static constexpr std::string_view key = "shape-matching";
  static constexpr auto frequency =
      Key("shape_frequency", "Hz", not_given, {0, 1e3},
          "Frequency with which a single particle swings about its place in the mesh's own shape. 0: the body does not "
          "keep its shape by itself.",
          {}, {.place = 40, .if_missing = "10 for meshes from files, else 0"});
  static constexpr std::array keys{&frequency};
  /// Of what draws a particle to its place, as a share of the critical damping, see internal_damping().
  static constexpr double damping_ratio = 0.05;
  static constexpr bool internal = true;
  static constexpr auto coordinate = Coordinate::offset;
  static constexpr const char* absent = "no body keeps its shape by itself";

  struct Data : ElementList<ShapePoint> {
    double stiffness = 0;  // m w^2 in N/m
  };
  static std::optional<Data> make(const BodyModel& model, const MeshSource& source);
};

/// Finds the pose of the goal shape in each of the first `used` lanes; the other lanes of `pose` are not changed.
template <class Real>
void fit_shape(const ShapeMoments<Real>& moments, int used, ShapePose<Real>& pose);

}  // namespace softbody
