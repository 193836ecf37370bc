#pragma once
// Material of a body: values by key. A key that is not given has its fallback.

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <initializer_list>
#include <map>
#include <span>
#include <string>

#include "softbody/model/key.h"

namespace softbody {

class Material {
 public:
  // Keys of the body as a whole; the others are declared beside the forces and the law of contact.
  static constexpr auto mass = Key("mass", "kg", 1, {1e-9, 1e9}, "The mass of a body. Its vertices share it equally.",
                                   {"Mass", "%.2f kg", 0.05f, 20, true}, {.place = 0});
  static constexpr auto internal_damping = Key("internal_damping", "1/s", 0, {0, 1e6},
                                               "How quickly a body stops wobbling: the rate at which it loses "
                                               "deformation velocities.",
                                               {"Damping", "%.1f 1/s", 0, 50}, {.place = 20});
  static constexpr auto thickness =
      Key("thickness", "m", not_given, {0, 1e3},
          "Distance that vertices keep to solids, so that the faces between them stay outside.", {},
          {.place = 22, .if_missing = "a hundredth of the body's radius"});
  static constexpr auto start_in_equilibrium =
      Key("start_in_equilibrium", "", true, {0, 1},
          "Springs and gas are brought into balance when the scene is loaded.", {}, {.place = 50, .is_switch = true});
  static constexpr std::array keys{&mass, &internal_damping, &thickness, &start_in_equilibrium};

  std::string name;

  /// Returns the value of a key: its fallback (maybe not_given) if it was not set.
  double operator[](const Key& key) const {
    const auto found = values_.find(&key);
    return found == values_.end() ? key.fallback : found->second;
  }
  double& operator[](const Key& key) { return values_.try_emplace(&key, key.fallback).first->second; }
  bool given(const Key& key) const { return !std::isnan((*this)[key]); }
  /// Sets the first keys of a list, e.g. set(BendSprings::keys, {75, 0.1}).
  void set(std::span<const Key* const> list, std::initializer_list<double> values) {
    assert(values.size() <= list.size());
    for (std::size_t i = 0; const double value : values) (*this)[*list[i++]] = value;
  }

  /// A key that was set to its fallback equals one that was not set.
  friend bool operator==(const Material& a, const Material& b) {
    return a.name == b.name && a.agrees_with(b) && b.agrees_with(a);
  }

 private:
  bool agrees_with(const Material& other) const {
    return std::ranges::all_of(values_, [&other](const auto& v) {
      const double its = other[*v.first];
      return v.second == its || (std::isnan(v.second) && std::isnan(its));
    });
  }
  std::map<const Key*, double> values_;
};

}  // namespace softbody
