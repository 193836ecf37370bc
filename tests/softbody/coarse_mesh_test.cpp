// Coarse meshes that are simulated in place of fine ones, and the fine ones that ride on them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>

#include "collide/methods.h"
#include "collide/oracle/surface_oracle.h"
#include "collide/surface/closest_features.h"
#include "softbody/mesh/coarse_mesh.h"
#include "softbody/mesh/surface.h"
#include "tests/softbody/helpers.h"
#include "tests/softbody/obj_lines.h"

namespace softbody::test {
namespace THIS_FILE {

/// A ball with bumps that are concave in places.
Mesh bumpy_ball(int subdivisions, double radius = 0.5, const glm::dvec3& centre = glm::dvec3(0.0)) {
  Mesh mesh = icosphere(subdivisions, 1);
  for (glm::dvec3& v : mesh.vertices)
    v = centre + radius * (1 + 0.2 * std::sin(5 * v.x) * std::sin(4 * v.y + 1) * std::cos(6 * v.z)) * v;
  return mesh;
}

void add(Mesh& mesh, const Mesh& other) {
  const Index first = static_cast<Index>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({a + first, b + first, c + first});
  connect_triangles(mesh);
}

/// A box of n x n squares on two of its sides and a tenth of n on the others: most of it is flat.
Mesh plate(int n) {
  Mesh mesh;
  std::map<std::array<int, 3>, Index> known;
  const int high = n / 10;
  const auto at = [&](int x, int y, int z) {
    const auto [found, is_new] = known.try_emplace({x, y, z}, static_cast<Index>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back(glm::dvec3(x, y, z) / double(n));
    return found->second;
  };
  const auto side = [&](int columns, int rows, const auto& corner) {
    for (int i = 0; i < columns; ++i)
      for (int j = 0; j < rows; ++j) {
        const Index a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1), d = corner(i, j + 1);
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
      }
  };
  for (const int end : {0, 1}) {
    side(n, n, [&](int i, int j) { return at(i, end * high, j); });
    side(n, high, [&](int i, int j) { return at(i, j, end * n); });
    side(n, high, [&](int i, int j) { return at(end * n, j, i); });
  }
  orient(mesh.triangles, mesh.vertices);
  connect_triangles(mesh);
  return mesh;
}

Mesh sheet(int n) {
  Mesh mesh = quad_grid(n, n, 1, 1);
  for (glm::dvec3& v : mesh.vertices) v.y = 0.1 * std::sin(6 * v.x) * std::cos(5 * v.z);
  connect_triangles(mesh);
  return mesh;
}

double distance(const glm::vec3& p, const Mesh& mesh) {
  double least = INFINITY;
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::array at{glm::vec3(mesh.vertices[a]), glm::vec3(mesh.vertices[b]), glm::vec3(mesh.vertices[c])};
    const glm::vec3 apart = collide::surface::closest_vertex_face(p, at[0], at[1], at[2]).separation;
    least = std::min(least, double{glm::length(apart)});
  }
  return least;
}

double extent(const Mesh& mesh) {
  glm::dvec3 lo(INFINITY), hi(-INFINITY);
  for (const glm::dvec3& v : mesh.vertices) lo = glm::min(lo, v), hi = glm::max(hi, v);
  return std::max({hi.x - lo.x, hi.y - lo.y, hi.z - lo.z});
}

struct Shape {
  const char* name;
  Mesh mesh;
  std::size_t parts;
};

std::vector<Shape> shapes() {
  std::vector<Shape> list{
      {"ball", bumpy_ball(4), 1}, {"plate", plate(40), 1}, {"sheet", sheet(40), 1}, {"two balls", bumpy_ball(4), 2}};
  add(list.back().mesh, bumpy_ball(3, 0.2, {1, 0, 0}));
  return list;
}

/// Returns where the fine vertices are if the coarse ones are `at` these places.
std::vector<glm::dvec3> placed(const CoarseMesh& coarse, const std::vector<glm::dvec3>& at) {
  static Embedding::Scratch scratch;  // which other meshes have used
  Points from, to;
  from.add(at);
  std::vector<glm::dvec3> fine(coarse.embedding.size(), glm::dvec3(0.0));
  to.add(fine);
  coarse.embedding.place(from, to.x, to.y, to.z, scratch);
  for (std::size_t v = 0; v < fine.size(); ++v) fine[v] = glm::dvec3(ConstPoints(to)[v]);
  return fine;
}

TEST(CoarseMesh, KeepsTheFormOfTheFineOne) {
  for (const Shape& shape : shapes())
    for (const std::size_t vertices : {200, 400, 800}) {
      const std::optional<CoarseMesh> coarse = coarsen(shape.mesh, vertices);
      ASSERT_TRUE(coarse) << shape.name << ' ' << vertices;
      std::vector<Triangle> turned = coarse->mesh.triangles;
      const SurfaceFindings found = orient(turned, coarse->mesh.vertices);  // throws at an edge of more than two faces
      EXPECT_EQ(found.turned_faces, 0u) << shape.name;
      EXPECT_EQ(found.components, shape.parts) << shape.name;
      EXPECT_EQ(coarse->mesh.closed, shape.mesh.closed) << shape.name;
      EXPECT_EQ(coarse->crossings, 0u) << shape.name;
      EXPECT_NEAR(double(coarse->mesh.vertices.size()), double(vertices), 0.1 * double(vertices)) << shape.name;
      if (!shape.mesh.closed) continue;
      const double kept =
          volume(coarse->mesh.vertices, coarse->mesh.triangles) / volume(shape.mesh.vertices, shape.mesh.triangles);
      EXPECT_NEAR(kept, 1, 0.06) << shape.name << ' ' << vertices;
    }
}

TEST(CoarseMesh, IsWithinTheStatedDistanceAndHasNoSlivers) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    const CoarseMesh coarse = coarsen(shape.mesh, 400).value();
    const std::vector<glm::dvec3>& at = coarse.mesh.vertices;
    for (const glm::dvec3& v : shape.mesh.vertices)
      EXPECT_LE(distance(glm::vec3(v), coarse.mesh), coarse.distance + 1e-6);
    for (const auto& [a, b] : coarse.mesh.edges)
      EXPECT_LE(distance(glm::vec3(0.5 * (at[a] + at[b])), shape.mesh), coarse.distance + 1e-6);
    EXPECT_LT(coarse.distance, 0.05 * extent(shape.mesh));
    const auto slim = std::ranges::count_if(coarse.mesh.triangles, [&](const Triangle& t) {  // less than ten degrees
      const auto cosine = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        return glm::dot(glm::normalize(b - a), glm::normalize(c - a));
      };
      const auto &a = at[t[0]], &b = at[t[1]], &c = at[t[2]];
      return std::max({cosine(a, b, c), cosine(b, c, a), cosine(c, a, b)}) > std::cos(0.17);
    });
    EXPECT_LT(double(slim), 0.05 * double(coarse.mesh.triangles.size()));
  }
}

TEST(CoarseMesh, HasAsManyVerticesAsItsPartsNeed) {
  Mesh balls = bumpy_ball(1, 0.1);
  for (int i = 1; i < 40; ++i) add(balls, bumpy_ball(1, 0.1, {0.3 * (i % 8), 0.3 * (i / 8), 0}));
  const std::optional<CoarseMesh> coarse = coarsen(balls, 50);  // of 1,680 vertices
  ASSERT_TRUE(coarse);
  EXPECT_LT(coarse->mesh.vertices.size(), 840u);
  std::vector<Triangle> triangles = coarse->mesh.triangles;
  EXPECT_EQ(orient(triangles, coarse->mesh.vertices).components, 40u);
  EXPECT_TRUE(coarse->mesh.closed);
}

TEST(CoarseMesh, KeepsAClosedPartClosedBesideAnOpenOne) {
  Mesh both = sheet(40);
  add(both, bumpy_ball(3, 0.2, {0, 1, 0}));
  const CoarseMesh coarse = coarsen(both, 200).value();
  std::map<Edge, int> faces;
  for (const auto& [a, b, c] : coarse.mesh.triangles)
    ++faces[ordered(a, b)], ++faces[ordered(b, c)], ++faces[ordered(c, a)];
  for (const auto& [edge, number] : faces)
    EXPECT_TRUE(number == 2 || coarse.mesh.vertices[edge[0]].y < 0.5) << "an open edge of the ball";
}

TEST(Embedding, HoldsEachVertexOnItsOwnSideOfAThinWall) {
  const Mesh ball = icosphere(4, 1);
  Mesh flat = ball;
  for (glm::dvec3& v : flat.vertices) v.y *= 0.01;
  const CoarseMesh coarse = coarsen(flat, 400).value();
  std::size_t wrong = 0;
  for (std::size_t v = 0; v < flat.vertices.size(); ++v) {
    const auto& [a, b, c] = coarse.embedding[v].corner;
    const auto& at = coarse.mesh.vertices;
    const double up = glm::cross(at[b] - at[a], at[c] - at[a]).y, side = ball.vertices[v].y;
    wrong += std::abs(side) > 0.3 && up * side < 0;
  }
  EXPECT_EQ(wrong, 0u);
}

TEST(Embedding, FollowsARigidMotion) {
  const glm::dquat turn = glm::angleAxis(2.1, glm::normalize(glm::dvec3(1, 2, -0.5)));
  const glm::dvec3 way(1.5, -2, 0.7);
  for (const Shape& shape : shapes()) {
    const CoarseMesh coarse = coarsen(shape.mesh, 300).value();
    std::vector<glm::dvec3> moved;
    for (const glm::dvec3& v : coarse.mesh.vertices) moved.push_back(turn * v + way);
    const std::vector rest = placed(coarse, coarse.mesh.vertices), now = placed(coarse, moved);
    double at_rest = 0, in_motion = 0;
    for (std::size_t v = 0; v < coarse.embedding.size(); ++v) {
      at_rest = std::max(at_rest, glm::distance(rest[v], shape.mesh.vertices[v]));
      in_motion = std::max(in_motion, glm::distance(now[v], turn * shape.mesh.vertices[v] + way));
    }
    EXPECT_LT(at_rest, 1e-6) << shape.name;
    EXPECT_LT(in_motion, 3e-6) << shape.name;
  }
}

TEST(Embedding, StaysFiniteWhereTheCoarseMeshCollapses) {
  const CoarseMesh coarse = coarsen(bumpy_ball(4), 300).value();
  const std::vector at = placed(coarse, std::vector(coarse.mesh.vertices.size(), glm::dvec3(1, 2, 3)));
  for (std::size_t v = 0; v < coarse.embedding.size(); ++v) ASSERT_LT(glm::distance(at[v], {1, 2, 3}), 1e-5);
}

/// Worlds of bodies whose mesh is a file of 2,562 vertices.
class FineBody : public testing::Test {
 protected:
  Scene scene(std::size_t resolution, int bodies, const std::string& surface = "surface") {
    std::string text;
    const Mesh mesh = bumpy_ball(4);
    for (const glm::dvec3& v : mesh.vertices) text += vertex(v);
    for (const auto& [a, b, c] : mesh.triangles) text += face({int(a) + 1, int(b) + 1, int(c) + 1});
    folder_.write("ball.obj", text);
    std::string toml = "[collision]\ntolerance = 0.05\ncontact_surface = \"" + surface +
                       "\"\n[[material]]\nmass = 1\nstructural = {stiffness = 200}\nbend = {stiffness = 50}\n"
                       "internal_damping = 10\n[ground]\n";
    for (int i = 0; i < bodies; ++i)
      toml += "[[body]]\nmesh = {kind = \"file\", path = \"ball.obj\", resolution = " + std::to_string(resolution) +
              "}\nposition = [" + std::to_string(0.2 * i) + ", " + std::to_string(0.8 + 1.3 * i) + ", 0]\n";
    return load_scene(folder_.write("scene.toml", toml));
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(FineBody, IsSimulatedByFewParticles) {
  const World world(scene(0, 1), {});
  const BodyModel& model = world.model(0);
  ASSERT_TRUE(model.fine);
  EXPECT_NEAR(double(model.mesh.vertices.size()), double(default_resolution), 0.05 * default_resolution);
  EXPECT_EQ(model.shown().mesh.vertices.size(), 2562u);
  EXPECT_EQ(world.bodies().vertex_count(), 2562u);
  EXPECT_EQ(world.positions().x.size(), 2562u);
  EXPECT_EQ(world.simulated().positions.x.size(), model.mesh.vertices.size());
  for (Index v = 0; v < 2562; ++v)
    EXPECT_LT(glm::distance(glm::dvec3(world.positions().x[v], world.positions().y[v], world.positions().z[v]),
                            model.shown().mesh.vertices[v] + glm::dvec3(0, 0.8, 0)),
              2e-6);
  const World own(scene(2562, 1), {});
  EXPECT_FALSE(own.model(0).fine) << "it has no more vertices";
  EXPECT_EQ(own.simulated().positions.x.data(), own.positions().x.data());
}

TEST_F(FineBody, IsMovedByContactsOfItsCoarseSurface) {
  for (const std::string surface : {"surface", "vertex-vertex"}) {
    SCOPED_TRACE(surface);
    World world(scene(400, 2, surface), {});
    run(world, 240);
    collide::Workers workers(1);
    const auto overlaps = collide::oracle::find_overlaps(world.simulated().positions,
                                                         {world.model(0).surface, world.model(1).surface}, workers);
    EXPECT_TRUE(overlaps.penetrations.empty() || surface != "surface") << overlaps.penetrations.size();
    const double distance = world.model(0).fine->imported->coarse->distance;
    EXPECT_NEAR(std::ranges::min(world.positions().y), 0, distance + 0.02);
    EXPECT_GT(glm::distance(motion(world, 0).centre, motion(world, 1).centre), 0.6);
    EXPECT_LT(measure(world).max_speed, std::sqrt(2 * 9.81 * 2.2)) << "no faster than a fall from the start";
  }
}

TEST_F(FineBody, ShowsContactsOfTheFineMesh) {
  World world(scene(400, 2), {});
  std::size_t most = 0;
  for (int frame = 0; frame < 90; ++frame) {
    world.step();
    if (frame % 15 > 0) continue;
    collide::Workers workers(1);
    collide::Result truth;
    collide::find_method("brute-force")->make()->detect(world.positions(), world.collision(), workers, truth);
    EXPECT_EQ(world.detection().contacts, truth.contacts);
    most = std::max(most, truth.contacts.size());
  }
  EXPECT_GT(most, 0u);
}

TEST_F(FineBody, IsUpToDateAfterEachSubstep) {
  Scene late = scene(400, 2);
  for (BodySource& body : late.bodies) body.appear = 1;
  World world(late, {.integrator = {.key = "semi-implicit-euler", .substeps = 4}});
  int looks = 0;
  world.step();
  float before = INFINITY;
  world.step([&] {
    ++looks;
    ASSERT_EQ(world.positions().y.size(), world.bodies().vertex_count());
    EXPECT_LT(world.positions().y[0], before);
    before = world.positions().y[0];
  });
  EXPECT_EQ(looks, 4);
}

TEST_F(FineBody, JoinsBodiesThatShowTheirOwnMesh) {
  World world(lone_body(spring_ball()), {});
  const Scene fine = scene(400, 1);
  BodySource source = fine.bodies[0];
  source.material = 0;
  source.position = {0, 3, 0};
  EXPECT_EQ(world.add(source), 1u);
  EXPECT_EQ(world.bodies().size(0), 162u);
  EXPECT_EQ(world.bodies().size(1), 2562u);
  world.step();
  for (Index v = 0; v < 162; ++v) EXPECT_EQ(world.positions().y[v], world.simulated().positions.y[v]);
  world.remove(1);
  EXPECT_EQ(world.positions().x.data(), world.simulated().positions.x.data());
  EXPECT_EQ(world.bodies().vertex_count(), 162u);
}

}  // namespace THIS_FILE
}  // namespace softbody::test
