#include "app/ui/tour/body_subset.h"

#include <cassert>

namespace app::ui {

BodySubset::BodySubset(const softbody::BodiesInMotion& world, softbody::BodyId a, softbody::BodyId b) {
  assert(a <= b);
  const collide::Frame all = world.positions();
  for (const softbody::BodyId body : {a, b}) {
    if (copy_.bodies.count() == 1 && a == b) break;
    first_[copy_.bodies.count()] = all.bodies->first[body];
    copy_.add(all, body);
  }
}

collide::Index BodySubset::to_world(collide::Index vertex) const {
  const bool second = vertex >= copy_.bodies.first[1];
  return first_[second] + vertex - copy_.bodies.first[second];
}

collide::Contact BodySubset::to_world(const collide::Contact& contact) const {
  return {to_world(contact.a), to_world(contact.b)};
}

}  // namespace app::ui
