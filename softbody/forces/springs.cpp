#include "softbody/forces/springs.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

#include "softbody/forces/model_forces.h"

namespace softbody {

std::optional<Springs::Data> Springs::join(const BodyModel& model, const std::vector<Edge>& pairs,
                                           const std::vector<double>& shares, double stiffness, double damping_ratio) {
  if (stiffness <= 0 || pairs.empty()) return {};
  assert(std::ranges::is_sorted(pairs) && std::ranges::all_of(pairs, [](const Edge& e) { return e[0] < e[1]; }));
  assert(shares.empty() || shares.size() == pairs.size());
  const double particle_mass = model.material[Material::mass] / model.mesh.stated_for;
  const double damping = 2 * damping_ratio * std::sqrt(stiffness * particle_mass / 2);  // reduced mass m / 2
  Data data;
  for (std::size_t s = 0; s < pairs.size(); ++s) {
    const auto [i, j] = pairs[s];
    const double share = shares.empty() ? 1 : shares[s];
    data.add({i, j, glm::distance(model.mesh.vertices[i], model.mesh.vertices[j]), share * stiffness, share * damping});
  }
  return data;
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
