// States changed out of a recorded one, to see what costs depend on.

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "app/base/text.h"
#include "app/report/detection/results.h"
#include "app/report/worlds.h"

namespace app::report {
namespace {

using collide::Index;
using glm::dvec3;

dvec3 middle(const MeasuredState& state) { return middle_of(state.view(), 0, state.bodies.vertex_count()); }

/// Returns these bodies of a state, in this order.
MeasuredState bodies_of(const MeasuredState& state, const std::vector<Index>& bodies, std::string change) {
  MeasuredState part{{}, state.frame, std::move(change)};
  for (const Index b : bodies) part.add(state.view(), b);
  return part;
}

/// Returns the numbers of all bodies, ascending in a key.
std::vector<Index> sorted_by(const std::vector<double>& keys) {
  std::vector<Index> order(keys.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::stable_sort(order, {}, [&](Index b) { return keys[b]; });
  return order;
}

/// Gives the bodies eight sizes, by chance, up to `ratio` times their own, and draws them apart about the middle of
/// all: as the mean size grows, and `apart` times.
MeasuredState placed(MeasuredState state, double apart, double ratio) {
  state.largest = ratio;
  std::mt19937 random(1);
  std::vector<double> sizes;
  std::map<std::pair<const collide::Shape*, double>, std::shared_ptr<const collide::Shape>> scaled;
  for (auto& shape : state.bodies.shape) {
    const double size = sizes.emplace_back(std::pow(ratio, double(random() % 8) / 7));
    auto& made = scaled[{shape.get(), size}];
    if (!made) {
      std::vector<glm::vec3> rest = shape->rest();
      for (glm::vec3& p : rest) p *= float(size);
      made = std::make_shared<collide::Shape>(shape->shared_topology(), std::move(rest));
    }
    shape = made;
  }
  apart *= std::accumulate(sizes.begin(), sizes.end(), 0.0) / double(sizes.size());
  const dvec3 centre = middle(state);
  for (Index b = 0; b < state.bodies.count(); ++b) {
    const dvec3 from = middle_of(state.view(), b), to = centre + apart * (from - centre);
    for (Index v = state.bodies.first[b]; v < state.bodies.first[b + 1]; ++v) {
      const dvec3 at = to + sizes[b] * (dvec3(position(state.view(), v)) - from);
      state.at.x[v] = float(at.x), state.at.y[v] = float(at.y), state.at.z[v] = float(at.z);
    }
  }
  state.change = fmt::format("x {:g}", ratio > 1 ? ratio : apart);
  return state;
}

enum Order { as_in_the_scene, along_x, shuffled };

MeasuredState in_order(const MeasuredState& state, double value) {
  constexpr std::array names{"as in the scene", "along x", "shuffled"};
  const int order = int(value);
  std::mt19937 random(1);
  std::vector<double> keys(state.bodies.count());
  for (Index b = 0; b < keys.size(); ++b)
    keys[b] = order == along_x ? middle_of(state.view(), b).x : order == shuffled ? random() : b;
  return bodies_of(state, sorted_by(keys), names[std::size_t(order)]);
}

}  // namespace

MeasuredState middle_bodies(const MeasuredState& state, double count) {
  const dvec3 centre = middle(state);
  std::vector<double> distances;
  for (Index b = 0; b < state.bodies.count(); ++b)
    distances.push_back(glm::distance(middle_of(state.view(), b), centre));
  std::vector<Index> nearest = sorted_by(distances);
  nearest.resize(std::size_t(std::min(count, double(nearest.size()))));
  std::ranges::sort(nearest);
  return bodies_of(state, nearest, grouped(nearest.size()) + " bodies");
}

std::vector<CostStudy> cost_studies() {
  return {{"growth", {3, 16, 47, 200, 800, HUGE_VAL}, middle_bodies},
          {"density", {0.7, 0.85, 1, 1.5, 3}, [](const auto& state, double apart) { return placed(state, apart, 1); }},
          {"sizes", {1, 2, 5, 10, 20}, [](const auto& state, double ratio) { return placed(state, 1, ratio); }},
          {"order", {as_in_the_scene, along_x, shuffled}, in_order}};
}

}  // namespace app::report
