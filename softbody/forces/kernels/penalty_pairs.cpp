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

glm::vec3 read(const VectorArray& array, std::size_t i) { return softbody::read(field(array), i); }
void write(VectorArray& array, std::size_t i, const glm::vec3& value) {
  array[0][i] = value.x, array[1][i] = value.y, array[2][i] = value.z;
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

void PenaltyPairs::push_back(const PenaltyPair& p) {
  const std::size_t i = size();
  resize(i + 1);
  contact[i] = p.contact;
  body_a[i] = p.body_a, body_b[i] = p.body_b;
  slot_a[i] = p.slot_a, slot_b[i] = p.slot_b;
  write(offset, i, p.offset), write(normal, i, p.normal), write(stretch, i, p.stretch);
  stiffness[i] = p.stiffness, friction[i] = p.friction, damped_mass[i] = p.damped_mass;
  restitution[i] = p.restitution;
}

PenaltyPair PenaltyPairs::operator[](std::size_t i) const {
  return {.contact = contact[i],
          .body_a = body_a[i],
          .body_b = body_b[i],
          .slot_a = slot_a[i],
          .slot_b = slot_b[i],
          .offset = read(offset, i),
          .normal = read(normal, i),
          .stiffness = stiffness[i],
          .friction = friction[i],
          .damped_mass = damped_mass[i],
          .restitution = restitution[i],
          .stretch = read(stretch, i)};
}

std::size_t PenaltyPairs::bytes() const {
  std::size_t sum = bytes_of(contact) + bytes_of(body_a) + bytes_of(body_b) + bytes_of(slot_a) + bytes_of(slot_b) +
                    bytes_of(a) + bytes_of(b);
  for_each_value(*this, [&](const auto& array) { sum += bytes_of(array); });
  return sum;
}

}  // namespace softbody
