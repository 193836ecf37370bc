#pragma once
// What the forces need of a body model.

#include <optional>
#include <tuple>
#include <vector>

#include "softbody/forces/table.h"

namespace softbody {

struct Nothing {};

namespace detail {
template <class F>
struct DataOf {
  using type = Nothing;
};
template <HasElements F>
struct DataOf<F> {
  using type = std::optional<typename F::Data>;
};
template <class... F>
std::tuple<typename DataOf<F>::type...> data_of(List<F...>);
}  // namespace detail

struct ModelForces {
  decltype(detail::data_of(Forces{})) data;
  // Half of the largest eigenvalues of the matrices of all forces between two particles and on single ones: see
  // pair_bound(). The bodies' shapes do not matter.
  double pair_stiffness = 0, pair_damping = 0;    // N/m, N s/m
  double offset_stiffness = 0, path_damping = 0;  // N/m, N s/m
  double pressure = 0;                            // Pa, about the largest; 0: no force depends on the volume

  template <class F>
  auto& of() {
    return std::get<index_of<F>>(data);
  }
  /// Works out the bounds from the data.
  void set_bounds(std::size_t particles);
};

/// Returns what a force needs of a model; nullptr if it does not act on its bodies.
template <HasElements F>
const typename F::Data* data(const BodyModel& model) {
  const auto& found = std::get<index_of<F>>(model.forces->data);
  return found ? &*found : nullptr;
}

/// Returns one kind of a model's springs.
template <class F>
const std::vector<Spring>& springs(const BodyModel& model) {
  static const std::vector<Spring> none;
  const auto* found = data<F>(model);
  return found ? found->exact : none;
}

/// Calls use(spring) for all springs of a model.
void for_each_spring(const BodyModel& model, auto&& use) {
  for_each_force(Forces{}, [&]<class F>(Name<F>) {
    if constexpr (std::is_base_of_v<Springs, F>)
      for (const Spring& s : springs<F>(model)) use(s);
  });
}

/// Returns the damping (N s/m) at one particle, for stable_step().
inline double damping_bound(const BodyModel& model) { return model.forces->pair_damping + model.forces->path_damping; }

/// Returns a body model whose starting shape is the mesh itself, whether or not that is in equilibrium.
std::shared_ptr<BodyModel> make_unbalanced_body_model(const MeshSource& mesh, const Material& material);

/// Returns a body model of the same mesh with another material. It keeps the starting shape, which is in equilibrium
/// only for the material that it was found for. `source`: the source of the model's mesh.
std::shared_ptr<const BodyModel> with_material(const BodyModel& model, const MeshSource& source,
                                               const Material& material);

}  // namespace softbody
