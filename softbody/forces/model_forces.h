#pragma once
// What the forces need of a body model.

#include <optional>
#include <tuple>
#include <variant>

#include "softbody/forces/table.h"

namespace softbody {

namespace detail {
template <class F>
struct DataOf {
  using type = std::monostate;
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
};

/// Returns what a force needs of a model; nullptr if it does not act on its bodies.
template <HasElements F>
const typename F::Data* data(const BodyModel& model) {
  const auto& found = std::get<index_of<F>>(model.forces->data);
  return found ? &*found : nullptr;
}

/// Returns what the laws of the volume v pull with together (Pa), and how fast that grows with it.
inline Jet volume_pull(const BodyModel& model, double v) {
  Jet sum = 0;
  for_each_force(Forces{}, [&]<class F>(Name<F>) {
    if constexpr (coordinate_of<F>() == Coordinate::volume)
      if (const auto* d = data<F>(model)) sum = sum + d->pull(Jet(v, 1));
  });
  return sum;
}

}  // namespace softbody
