#include "collide/core/settings.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

#include "collide/core/body_boxes.h"
#include "collide/core/cutoff.h"
#include "collide/core/cuts.h"

namespace collide {

namespace {

static_assert(cuts_along(0, max_levels) <= Cuts::max_depth);

template <class Value>
std::string complaint(const char* setting, const Value& value, const char* allowed) {
  std::array<char, 32> digits;  // as few as tell the value from its neighbours
  const char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return std::string(setting) + " is " + std::string(static_cast<const char*>(digits.data()), end) + "; it must be " +
         allowed;
}

}  // namespace

std::string problem(const Settings& settings) {
  if (!(settings.tolerance >= min_tolerance && settings.tolerance <= max_tolerance))
    return complaint("tolerance", settings.tolerance, "1e-18 to 1e18 m");
  if (settings.levels < 0 || settings.levels > max_levels) return complaint("levels", settings.levels, "0 to 15");
  if (settings.buckets < 1 || settings.buckets > max_buckets) {
    return complaint("buckets", settings.buckets, "1 to 16777216");
  }
  for (int axis = 0; settings.cell_size && axis < 3; ++axis) {
    const float side = (*settings.cell_size)[axis];
    if (!(std::isfinite(side) && side > 0))
      return complaint("cell size", side, "finite and above 0 m along every axis");
  }
  for (const std::uint32_t prime : settings.primes) {
    if (prime == 0) return complaint("prime", prime, "above 0");
  }
  return {};
}

std::string hash_warning(const Settings& settings) {
  const auto& prime = settings.primes;
  std::ostringstream text;
  const auto add = [&]() -> std::ostream& { return text << (text.tellp() > 0 ? "; " : ""); };
  for (std::size_t i = 0; i < prime.size(); ++i) {
    if (prime[i] % settings.buckets == 0) {
      add() << "prime " << prime[i] << " is 0 modulo " << settings.buckets << " buckets, so its axis is lost";
    }
    for (std::size_t j = i + 1; j < prime.size(); ++j) {
      if (prime[i] % settings.buckets == prime[j] % settings.buckets) {
        add() << "primes " << prime[i] << " and " << prime[j] << " are equal modulo " << settings.buckets
              << " buckets, so two axes are mixed";
      }
    }
  }
  return text.str();
}

glm::vec3 automatic_cell_size(const Frame& frame, int levels, float tolerance) {
  std::array<std::vector<float>, 3> at{
      {{frame.x.begin(), frame.x.end()}, {frame.y.begin(), frame.y.end()}, {frame.z.begin(), frame.z.end()}}};
  for (Index body = 0; body < frame.bodies->count(); ++body) {
    std::size_t v = frame.bodies->first[body];
    for (const glm::vec3& rest : frame.bodies->shape[body]->rest()) {
      for (int axis = 0; axis < 3; ++axis) at[static_cast<std::size_t>(axis)][v] = rest[axis];
      ++v;
    }
  }
  BodyBoxes bodies;
  Result ignored;
  bodies.build({at[0], at[1], at[2], frame.bodies}, ignored);
  std::array<double, 3> widest{};
  Cuts cuts;
  for (const Index body : bodies.live) {
    const Aabb& box = bodies.box[body];
    for (int axis = 0; axis < 3; ++axis) {
      cuts.build(box.lo[axis], box.hi[axis], cuts_along(axis, levels));
      for (int i = 0; i < cuts.intervals(); ++i) {
        widest[axis] = std::max(widest[axis], double{cuts.border[i + 1]} - double{cuts.border[i]});
      }
    }
  }
  const auto size = [&](int axis) { return round_up(widest[axis] + tolerance); };
  return {size(0), size(1), size(2)};
}

}  // namespace collide
