#include "softbody/forces/kernels/penalty_pairs.h"

#include <algorithm>

namespace softbody {
namespace {

/// Calls use(array) for the arrays of floats.
template <class Pairs, class Use>
void for_each_value(Pairs& p, const Use& use) {
  for (auto* vectors : {&p.offset, &p.normal, &p.stretch})
    for (auto& component : *vectors) use(component);
  for (auto* values : {&p.stiffness, &p.friction, &p.damped_mass, &p.restitution}) use(*values);
}

/// Calls use(array) for all arrays.
template <class Pairs, class Use>
void for_each_array(Pairs& p, const Use& use) {
  use(p.contact);
  for (auto* bodies : {&p.body_a, &p.body_b}) use(*bodies);
  for (auto* slots : {&p.slot_a, &p.slot_b}) use(*slots);
  for (auto* particles : {&p.a, &p.b}) use(*particles);
  for_each_value(p, use);
}

}  // namespace

void PenaltyPairs::resize(std::size_t count) {
  const std::size_t whole = (count + lanes - 1) / lanes * lanes;
  contact.resize(count);
  for (auto* bodies : {&body_a, &body_b}) bodies->resize(count);
  for (auto* slots : {&slot_a, &slot_b}) slots->resize(count);
  for (auto* particles : {&a, &b}) {
    particles->resize(whole);
    std::fill(particles->begin() + std::ptrdiff_t(count), particles->end(), 0u);
  }
  for_each_value(*this, [&](auto& array) { array.resize(whole); });
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
