#include "app/ui/tour/body_subset.h"

#include <cassert>

namespace app::ui {

BodySubset::BodySubset(const softbody::BodiesInMotion& world, softbody::BodyId a, softbody::BodyId b) {
  assert(a <= b);
  const collide::Frame all = world.positions();
  const auto copy = [&](std::span<const float> from, std::vector<float>& to, softbody::BodyId body) {
    const auto part = from.subspan(all.bodies->first[body], all.bodies->size(body));
    to.insert(to.end(), part.begin(), part.end());
  };
  for (const softbody::BodyId body : {a, b}) {
    if (bodies_.count() == 1 && a == b) break;
    first_[bodies_.count()] = all.bodies->first[body];
    copy(all.x, at_.x, body);
    copy(all.y, at_.y, body);
    copy(all.z, at_.z, body);
    bodies_.add(all.bodies->shape[body]);
  }
}

collide::Index BodySubset::to_world(collide::Index vertex) const {
  const bool second = vertex >= bodies_.first[1];
  return first_[second] + vertex - bodies_.first[second];
}

collide::Contact BodySubset::to_world(const collide::Contact& contact) const {
  return {to_world(contact.a), to_world(contact.b)};
}

}  // namespace app::ui
