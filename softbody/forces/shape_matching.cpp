#include "softbody/forces/shape_matching.h"

#include <numbers>

#include <glm/mat3x3.hpp>

#include "softbody/state/best_rotation.h"

namespace softbody {

template <class Real>
void fit_shape(const ShapeMoments<Real>& moments, int used, ShapePose<Real>& pose) {
  for (int l = 0; l < used; ++l) {
    glm::dmat3 covariance;
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r) covariance[c][r] = double(moments.covariance[3 * c + r][l]);
    const glm::dmat3 rotation = best_rotation(covariance);
    for (int c = 0; c < 3; ++c) {
      pose.centre[c][l] = moments.mean[c][l];
      for (int r = 0; r < 3; ++r) pose.rotation[3 * c + r][l] = Real(rotation[c][r]);
    }
  }
}

template void fit_shape<float>(const ShapeMoments<float>&, int, ShapePose<float>&);
template void fit_shape<double>(const ShapeMoments<double>&, int, ShapePose<double>&);

std::optional<ShapeMatching::Data> ShapeMatching::make(const BodyModel& model, const MeshSource& source) {
  const double by_kind = source.kind == "file" ? mesh_file_shape_frequency : 0;
  const double rate = 2 * std::numbers::pi * (model.material.given(frequency) ? model.material[frequency] : by_kind);
  if (rate <= 0) return {};
  Data data;
  data.stiffness = model.particle_mass * rate * rate;
  glm::dvec3 mean(0.0);
  for (const glm::dvec3& v : model.mesh.vertices) mean += v / double(model.mesh.vertices.size());
  for (const glm::dvec3& v : model.mesh.vertices) {
    const glm::dvec3 q = v - mean;
    data.add({q.x, q.y, q.z});
  }
  return data;
}

}  // namespace softbody
