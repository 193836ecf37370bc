#include "softbody/forces/kernels/penalty_pairs.h"

#include <algorithm>
#include <type_traits>

namespace softbody {
namespace {

/// Calls use(array) for each array.
template <class Pairs, class Use>
void for_each_array(Pairs& p, const Use& use) {
  use(p.contact);
  for (auto* numbers : {&p.body_a, &p.body_b, &p.slot_a, &p.slot_b}) use(*numbers);
  for (auto* particles : {&p.a, &p.b}) use(*particles);
  for (auto* vectors : {&p.offset, &p.normal, &p.stretch})
    for (auto& component : *vectors) use(component);
  for (auto* values : {&p.stiffness, &p.friction, &p.damped_mass, &p.restitution}) use(*values);
}

}  // namespace

void PenaltyPairs::resize(std::size_t count) {
  const std::size_t whole = (count + lanes - 1) / lanes * lanes;
  for_each_array(*this, [&]<class Array>(Array& array) {
    array.resize(std::is_same_v<Array, LaneArray<typename Array::value_type>> ? whole : count);
  });
  for (auto* particles : {&a, &b}) std::fill(particles->begin() + std::ptrdiff_t(count), particles->end(), 0u);
}

void PenaltyPairs::keep(const std::vector<std::size_t>& which) {
  for_each_array(*this, [&](auto& array) {
    for (std::size_t i = 0; i < which.size(); ++i) array[i] = array[which[i]];
  });
  resize(which.size());
}

std::size_t PenaltyPairs::bytes() const {
  std::size_t sum = 0;
  for_each_array(*this, [&](const auto& array) { sum += bytes_of(array); });
  return sum;
}

}  // namespace softbody
