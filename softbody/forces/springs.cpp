#include "softbody/forces/springs.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

#include "softbody/forces/model_forces.h"

namespace softbody {

/// A net of equal springs has the stiffness of a sheet, however fine the net is (Young's modulus times thickness =
/// 2 k / sqrt(3)), so one stiffness in N/m fits every mesh. Where more than six springs meet (the number in a regular
/// net), they share the stiffness of six, so that the middle of a fan needs no shorter steps than the rest.
std::optional<Springs::Data> Springs::join(const BodyModel& p, const std::vector<Edge>& pairs, double stiffness,
                                           double damping_ratio) {
  if (stiffness <= 0 || pairs.empty()) return {};
  assert(std::ranges::is_sorted(pairs) && std::ranges::all_of(pairs, [](const Edge& e) { return e[0] < e[1]; }));
  Data data;
  std::vector<int> meeting(p.mesh.vertices.size(), 0);
  for (const auto& [i, j] : pairs) ++meeting[i], ++meeting[j];
  for (const auto& [i, j] : pairs) {
    const double own = stiffness * std::min(1.0, 6.0 / std::max(meeting[i], meeting[j]));
    const double damping = 2 * damping_ratio * std::sqrt(own * p.particle_mass / 2);  // reduced mass m / 2
    const double rest = glm::distance(p.mesh.vertices[i], p.mesh.vertices[j]);
    data.add({i, j, rest, own, damping});
  }
  return data;
}

/// Springs of very fine meshes from files become softer, so that a frame takes no more substeps than with the finest
/// mesh that has full springs.
double Springs::share(const MeshSource& source) {
  constexpr double finest = 2000;  // vertices
  return source.kind == "file" ? std::min(1.0, finest / double(source.vertex_count())) : 1;
}

template <class Kind>
const std::vector<Spring>& springs(const BodyModel& model) {
  static const std::vector<Spring> none;
  const auto* found = data<Kind>(model);
  return found ? found->exact : none;
}
template const std::vector<Spring>& springs<StructuralSprings>(const BodyModel&);
template const std::vector<Spring>& springs<BendSprings>(const BodyModel&);
template const std::vector<Spring>& springs<ShearSprings>(const BodyModel&);

void for_each_spring(const BodyModel& model, const std::function<void(const Spring&)>& use) {
  for_each_force(Forces{}, [&]<class F>(Name<F>) {
    if constexpr (std::is_base_of_v<Springs, F>)
      for (const Spring& s : springs<F>(model)) use(s);
  });
}

}  // namespace softbody
