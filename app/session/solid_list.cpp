#include "app/session/solid_list.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include <glm/common.hpp>

namespace app::session {
namespace {

/// Moves the places of a shape.
struct Mover {
  glm::dvec3 by;
  bool limited = false;
  void operator()(const char*, softbody::solid::Place p) {
    const glm::dvec3 limit(max_solid_coordinate);  // one that is beyond them may come back
    if (!std::exchange(limited, true))
      by = glm::clamp(p.value + by, glm::min(-limit, p.value), glm::max(limit, p.value)) - p.value;
    p.value += by;
  }
  void operator()(const char*, auto) {}
};

}  // namespace

std::vector<std::size_t> listed(const std::vector<softbody::Solid>& solids) {
  std::vector<std::size_t> order(solids.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(
      order, {}, [&](std::size_t i) { return std::pair(solids[i].traits().half_space, solids[i].traits().single); });
  return order;
}

softbody::Solid moved(softbody::Solid solid, const glm::dvec3& by) {
  solid.values(Mover{by});
  return solid;
}

std::string solid_name(const std::vector<softbody::Solid>& solids, std::size_t index) {
  assert(index < solids.size());
  std::string name(solids[index].traits().name);
  const auto same = [&](const softbody::Solid& one) { return one.traits().name == name; };
  if (std::ranges::count_if(solids, same) == 1) return name;
  return name + ' ' + std::to_string(std::count_if(&solids[0], &solids[index] + 1, same));
}

}  // namespace app::session
