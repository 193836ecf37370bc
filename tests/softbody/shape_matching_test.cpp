// Shape matching: the rotation against ones that are known, and which bodies have it. forces_test.cpp has its force.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "softbody/forces/shape_matching.h"
#include "softbody/integrate/resistance.h"
#include "softbody/mechanics/deformation.h"
#include "softbody/mechanics/make_body_model.h"
#include "softbody/state/best_rotation.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

/// By Rodrigues' formula.
glm::dmat3 rotation(const glm::dvec3& axis, double angle) {
  const glm::dvec3 n = glm::normalize(axis);
  const glm::dmat3 cross(glm::dvec3(0, n.z, -n.y), glm::dvec3(-n.z, 0, n.x), glm::dvec3(n.y, -n.x, 0));
  return glm::dmat3(1.0) + std::sin(angle) * cross + (1 - std::cos(angle)) * cross * cross;
}

glm::dmat3 random_rotation(std::mt19937& random) {
  const glm::dvec3 axis = random_vector(random, 1);
  return rotation(axis, uniform(random, -3.14, 3.14));
}

double distance(const glm::dmat3& a, const glm::dmat3& b) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) sum += glm::dot(a[c] - b[c], a[c] - b[c]);
  return std::sqrt(sum);
}

TEST(BestRotation, IsThePolarFactorOfAStretchedBody) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const glm::dmat3 r = random_rotation(random), axes = random_rotation(random);
    const glm::dvec3 size{uniform(random, 0.5, 3), uniform(random, 0.1, 3), i % 3 ? uniform(random, 0.1, 3) : 0};
    glm::dmat3 stretch(0.0);  // symmetric; every third one is flat
    for (int k = 0; k < 3; ++k) stretch += size[k] * glm::outerProduct(axes[k], axes[k]);
    EXPECT_LT(distance(best_rotation(r * stretch), r), 1e-9) << i;
  }
}

TEST(BestRotation, IsNeverAReflectionAndTakesAnything) {
  const glm::dmat3 mirror(glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -0.5));
  for (const glm::dmat3& m :
       {mirror, glm::dmat3(0.0), glm::dmat3(-1.0), glm::outerProduct(glm::dvec3(1), glm::dvec3(2))}) {
    const glm::dmat3 r = best_rotation(m);
    EXPECT_NEAR(glm::determinant(r), 1, 1e-12);
    EXPECT_LT(distance(glm::transpose(r) * r, glm::dmat3(1.0)), 1e-12);
  }
  best_rotation(glm::dmat3(std::nan("")));  // comes back
}

Material shape_only() {
  Material m = spring_ball();
  m[StructuralSprings::stiffness] = m[BendSprings::stiffness] = 0;
  m[ShapeMatching::frequency] = 3;
  return m;
}

TEST(ShapeMatching, ARigidMotionCostsNothing) {
  const auto p = make_body_model({}, shape_only());
  std::vector<glm::dvec3> x;
  for (const glm::dvec3& v : p->mesh.vertices) x.push_back(rotation({3, -1, 2}, 3) * v + glm::dvec3(5, 6, 7));
  EXPECT_LT(elastic_energy(*p, x), 1e-20);
  EXPECT_GT(elastic_energy(*p, std::vector<glm::dvec3>(x.size(), x[0])), 1);
}

TEST(ShapeMatching, IsForMeshesFromFilesUnlessTheMaterialSaysOtherwise) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  const MeshSource source = MeshSource::from_file({.path = file});
  Material m = spring_ball();
  EXPECT_FALSE(data<ShapeMatching>(*make_body_model({}, m)));
  const auto p = make_body_model(source, m);
  const double rate = 2 * 3.14159265358979 * mesh_file_shape_frequency;
  ASSERT_TRUE(data<ShapeMatching>(*p));
  EXPECT_NEAR(data<ShapeMatching>(*p)->stiffness, p->particle_mass * rate * rate,
              1e-9 * p->particle_mass * rate * rate);
  EXPECT_NEAR(internal_damping(*p), 2 * ShapeMatching::damping_ratio * rate, 1e-9 * rate);
  m[Material::internal_damping] = 1e3;
  EXPECT_EQ(internal_damping(*make_body_model(source, m)), 1e3) << "the larger one";
  m[ShapeMatching::frequency] = 0;
  EXPECT_FALSE(data<ShapeMatching>(*make_body_model(source, m)));
}

}  // namespace THIS_FILE
}  // namespace softbody::test
