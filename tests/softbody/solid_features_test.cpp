// Faces and edges of bodies against solids that are smaller than a face, or sharp.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "softbody/contact/solid_geometry.h"
#include "softbody/contact/solid_surface.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

/// Of the points of all faces, on a grid over each, to the solids; m.
double min_distance(const World& world) {
  constexpr int cuts = 12;
  double least = std::numeric_limits<double>::infinity();
  for (BodyId body = 0; body < world.bodies().count(); ++body) {
    for (const Triangle& t : world.model(body).mesh.triangles) {
      std::array<glm::dvec3, 3> c;
      for (std::size_t k = 0; k < 3; ++k) c[k] = world.particle(body, t[k]).position;
      for (int i = 0; i <= cuts; ++i) {
        for (int j = 0; i + j <= cuts; ++j) {
          const glm::dvec3 p = (double(i) * c[0] + double(j) * c[1] + double(cuts - i - j) * c[2]) / double(cuts);
          for (const Solid& s : world.scene().solids) least = std::min(least, surface_at(s, p).distance);
        }
      }
    }
  }
  return least;
}

struct Case {
  const char* name;
  Solid solid;
};

class SolidFeatures : public testing::TestWithParam<Case> {
 protected:
  /// A ball with the solid just below it, which it falls on and stays upon or rolls off.
  static double deepest(ContactSurface surface) {
    Scene scene = lone_body(gas_ball(), {0, -2, 0});
    scene.gravity = {0, -9.81, 0};
    scene.bodies[0].position = {0.03, 0.55, 0.02};
    scene.contact_surface = surface;
    set_solid(scene, GetParam().solid);
    World world(scene, {});
    double least = std::numeric_limits<double>::infinity();
    for (int frame = 0; frame < 60; ++frame) {
      world.step();
      least = std::min(least, min_distance(world));
    }
    EXPECT_TRUE(measure(world).finite);
    return -least;
  }
};

TEST_P(SolidFeatures, StayOutOfFacesBetweenTheVertices) {
  const double vertices_alone = deepest(ContactSurface::vertices);
  EXPECT_GT(vertices_alone, 0.008) << "between vertices there is room for it";
  EXPECT_LT(deepest(ContactSurface::surfaces), 0.001);
}

SolidBox box(const glm::dvec3& centre, const glm::dvec3& half, const glm::dvec3& x, const glm::dvec3& y) {
  const glm::dvec3 u = glm::normalize(x), w = glm::normalize(glm::cross(u, y));
  return {.centre = centre, .half_size = half, .axes = {u, glm::cross(w, u), w}};
}

const Case cases[]{
    {"SmallSphere", {SolidSphere{.centre = {0, -0.12, 0}, .radius = 0.1}}},
    {"Rod", {SolidCapsule{.from = {-1, -0.1, 0.3}, .to = {1, -0.1, -0.2}, .radius = 0.05}}},
    {"Spike", {SolidCapsule{.from = {0, -1, 0}, .to = {0, -0.07, 0}, .radius = 0.03}}},
    {"Edge", {box({-0.1414, -0.7414, 0}, {0.6, 0.4, 2}, {1, 1, 0}, {-1, 1, 0})}},
    {"Corner", {box({0, -0.55, 0}, {0.3, 0.3, 0.3}, {1, 1.4, 0}, {-1, 1, 1})}},
    {"Plate", {box({0, -0.55, 0}, {1, 0.5, 0.01}, {1, 0, 0.3}, {0, 1, 0})}},
};
INSTANTIATE_TEST_SUITE_P(All, SolidFeatures, testing::ValuesIn(cases),
                         [](const auto& c) { return std::string(c.param.name); });

TEST(InteriorOf, HasTheCornersAndEdgesOfABoxAsCores) {
  const SolidBox b = box({0.5, 0.25, -0.5}, {0.7, 0.2, 0.4}, {1, 1.4, 0}, {-1, 1, 1});
  std::vector<glm::dvec3> corners;
  int edges = 0;
  for (const SolidCore& core : interior_of(b).cores) {
    int across = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto along = [&](const glm::dvec3& v) { return glm::dot(v, b.axes[axis]); };
      const double from = along(core.from - b.centre), to = along(core.to - b.centre);
      EXPECT_NEAR(std::abs(from), b.half_size[axis], 1e-12);
      EXPECT_NEAR(std::abs(to), b.half_size[axis], 1e-12);
      EXPECT_NEAR(along(core.out), (from > 0) - (to < 0), 1e-12) << "0 along an edge";
      across += (from > 0) != (to > 0);
    }
    EXPECT_EQ(across, core.point() ? 0 : 1);
    if (core.point()) {
      for (const glm::dvec3& other : corners) EXPECT_GT(glm::distance(core.from, other), 0.3);
      corners.push_back(core.from);
    }
    edges += !core.point();
  }
  EXPECT_EQ(corners.size(), 8u);
  EXPECT_EQ(edges, 12);
}

/// Between two vertices' places, on a sphere so small that no vertex meets it.
double rebound(double restitution) {
  Material m = gas_ball();
  m[contact::rebound_speed] = 2;
  m[Material::internal_damping] = 10;
  Scene scene = lone_body(m, {0, -8, 0});
  scene.bodies[0].position = {0.003, 0.62, 0.002};
  scene.contact_surface = ContactSurface::surfaces;
  set_solid(scene,
            {.shape = SolidSphere{.centre = {0, -0.12, 0}, .radius = 0.1}, .friction = 0, .restitution = restitution});
  World world(scene, {});
  double fastest = 0;
  for (int i = 0; i < 60; ++i) {
    world.step();
    fastest = std::max(fastest, motion(world, 0).velocity.y);
  }
  return fastest;
}

TEST(SolidFeature, ThrowsBackByTheSolidsRestitution) {
  const double soft = rebound(0);  // by its springs and gas
  EXPECT_LT(soft, 2);
  double before = soft;
  for (const double e : {0.4, 0.6, 0.8}) {
    const double speed = rebound(e);
    EXPECT_GT(speed, before + 1);
    EXPECT_LT(speed, soft + e * 8 * 1.05);
    before = speed;
  }
}

}  // namespace THIS_FILE
}  // namespace softbody::test
