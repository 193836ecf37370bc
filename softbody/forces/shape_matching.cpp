#include "softbody/forces/shape_matching.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "softbody/forces/best_rotation.h"

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
      for (int r = 0; r < 3; ++r) pose.rotation[3 * c + r][l] = static_cast<Real>(rotation[c][r]);
    }
  }
}

template void fit_shape<float>(const ShapeMoments<float>&, int, ShapePose<float>&);
template void fit_shape<double>(const ShapeMoments<double>&, int, ShapePose<double>&);

double shape_stiffness(const BodyModel& p) { return p.particle_mass * p.shape_rate * p.shape_rate; }

double shape_energy(const BodyModel& p, const std::vector<glm::dvec3>& x) {
  if (p.goal.empty()) return 0;
  glm::dvec3 centre(0.0);
  for (std::size_t i = 0; i < p.goal.size(); ++i) centre += (x[i] - x[0]) / double(x.size());
  centre += x[0];
  glm::dmat3 covariance(0.0);
  for (std::size_t i = 0; i < p.goal.size(); ++i) covariance += glm::outerProduct(x[i] - centre, p.goal[i]);
  const glm::dmat3 rotation = best_rotation(covariance);
  double square_sum = 0;
  for (std::size_t i = 0; i < p.goal.size(); ++i) {
    const glm::dvec3 away = x[i] - centre - rotation * p.goal[i];
    square_sum += glm::dot(away, away);
  }
  return 0.5 * shape_stiffness(p) * square_sum;
}

}  // namespace softbody
