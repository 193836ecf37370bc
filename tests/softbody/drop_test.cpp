// The drop scene, 800 frames: what the captions of the paper's figures 10 to 13 say, and bounds that hold throughout.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

constexpr double radius = 0.5;     // of a body
constexpr double touching = 0.01;  // the bodies keep 5 mm from solids

/// The bodies that lie against the solid sphere.
std::set<BodyId> on_sphere(const World& world) {
  const SolidSphere& sphere = shape_of<SolidSphere>(world.scene());
  std::set<BodyId> bodies;
  for (const SolidContactPoint& c : solid_contacts(world)) {
    const collide::Frame p = world.positions();
    const glm::dvec3 x(p.x[c.vertex], p.y[c.vertex], p.z[c.vertex]);
    if (glm::distance(x, sphere.centre) < sphere.radius + touching) bodies.insert(world.bodies().body_of(c.vertex));
  }
  return bodies;
}

/// The largest difference in height of the centres of two bodies that touch.
double stacked(const World& world) {
  double height = 0;
  for (const collide::Contact& c : world.detection().contacts) {
    const BodyId a = world.bodies().body_of(c.a), b = world.bodies().body_of(c.b);
    if (a != b) height = std::max(height, std::abs(motion(world, a).centre.y - motion(world, b).centre.y));
  }
  return height;
}

TEST(Drop, ShowsWhatTheCaptionsSay) {
  World world(drop_scene(), {});
  const SolidSphere sphere = shape_of<SolidSphere>(world.scene());
  run(world, 100);  // figure 10: a body above the solid sphere
  const glm::dvec3 first = motion(world, 0).centre;
  EXPECT_GT(first.y - radius, sphere.centre.y + sphere.radius);
  EXPECT_LT(std::hypot(first.x - sphere.centre.x, first.z - sphere.centre.z), sphere.radius);
  EXPECT_TRUE(solid_contacts(world).empty());

  std::set<BodyId> hit, around;  // figure 11: it has hit the sphere
  while (world.frame() < 405) {
    world.step();
    const std::set<BodyId> now = on_sphere(world);
    if (world.frame() <= 400) hit.insert(now.begin(), now.end());
    if (world.frame() >= 395) around.insert(now.begin(), now.end());
  }
  EXPECT_TRUE(hit.contains(0));
  EXPECT_FALSE(around.empty());

  run(world, 600 - 405);  // figure 12: bodies on bodies
  EXPECT_GT(stacked(world), 0.5 * radius);

  run(world, 800 - 600);  // figure 13: all lie on the floor
  for (BodyId b = 0; b < world.bodies().count(); ++b) {
    const glm::dvec3 centre = motion(world, b).centre;
    EXPECT_LT(centre.y, 1.05 * radius) << "body " << b;
    EXPECT_GT(centre.y, 0.6 * radius) << "body " << b;
    std::size_t floor = 0;
    for (const SolidContactPoint& c : solid_contacts(world))
      floor += world.bodies().body_of(c.vertex) == b && world.positions().y[c.vertex] < touching;
    EXPECT_GE(floor, 1u) << "body " << b << " is not on the floor";
  }
  EXPECT_LT(stacked(world), 0.2 * radius) << "none on another";
}

}  // namespace THIS_FILE
}  // namespace softbody::test
