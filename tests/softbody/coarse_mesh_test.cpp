// Coarse meshes that are simulated in place of fine ones, and the fine ones that ride on them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <set>

#include "collide/methods.h"
#include "collide/oracle/surface_oracle.h"
#include "softbody/mesh/coarse_mesh.h"
#include "softbody/mesh/surface.h"
#include "softbody/world/snapshot.h"
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

/// Distance of a point from a triangle, by the plane and the sides.
double distance(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const auto from_side = [&](const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 way = to - from;
    const double length2 = glm::dot(way, way);
    const double t = length2 > 0 ? std::clamp(glm::dot(p - from, way) / length2, 0.0, 1.0) : 0;
    return glm::distance(p, from + t * way);
  };
  double least = std::min({from_side(a, b), from_side(b, c), from_side(c, a)});
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double area = glm::length(normal);
  const auto inside = [&](const glm::dvec3& from, const glm::dvec3& to) {
    return glm::dot(glm::cross(to - from, p - from), normal) >= 0;
  };
  if (area > 0 && inside(a, b) && inside(b, c) && inside(c, a))
    least = std::min(least, std::abs(glm::dot(p - a, normal)) / area);
  return least;
}

double distance(const glm::dvec3& p, const Mesh& mesh) {
  double least = INFINITY;
  for (const auto& [a, b, c] : mesh.triangles)
    least = std::min(least, distance(p, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]));
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
std::vector<glm::dvec3> placed(const CoarseMesh& coarse, const std::vector<glm::dvec3>& at,
                               Embedding::Scratch& scratch) {
  Points from, to;
  from.add(at);
  std::vector<glm::dvec3> fine(coarse.embedding.size(), glm::dvec3(0.0));
  to.add(fine);
  coarse.embedding.place(from, to.x, to.y, to.z, scratch);
  for (std::size_t v = 0; v < fine.size(); ++v) fine[v] = glm::dvec3(ConstPoints(to)[v]);
  return fine;
}
std::vector<glm::dvec3> placed(const CoarseMesh& coarse, const std::vector<glm::dvec3>& at) {
  Embedding::Scratch scratch;
  return placed(coarse, at, scratch);
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

TEST(CoarseMesh, HasNoSlivers) {
  for (const Shape& shape : shapes()) {
    const CoarseMesh coarse = coarsen(shape.mesh, 400).value();
    std::size_t slim = 0;
    for (const Triangle& t : coarse.mesh.triangles) {
      double smallest = INFINITY;  // angle
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 at = coarse.mesh.vertices[t[k]],
                         one = glm::normalize(coarse.mesh.vertices[t[(k + 1) % 3]] - at),
                         other = glm::normalize(coarse.mesh.vertices[t[(k + 2) % 3]] - at);
        smallest = std::min(smallest, std::acos(std::clamp(glm::dot(one, other), -1.0, 1.0)));
      }
      slim += smallest < 0.17;  // ten degrees
    }
    EXPECT_LT(double(slim), 0.05 * double(coarse.mesh.triangles.size())) << shape.name;
  }
}

TEST(CoarseMesh, IsWithinTheStatedDistance) {
  for (const Shape& shape : shapes()) {
    const CoarseMesh coarse = coarsen(shape.mesh, 400).value();
    double farthest = 0;
    for (const glm::dvec3& v : shape.mesh.vertices) farthest = std::max(farthest, distance(v, coarse.mesh));
    EXPECT_LE(farthest, coarse.distance + 1e-6) << shape.name;
    for (const auto& [a, b] : coarse.mesh.edges)
      EXPECT_LE(distance(0.5 * (coarse.mesh.vertices[a] + coarse.mesh.vertices[b]), shape.mesh), coarse.distance + 1e-6)
          << shape.name;
    EXPECT_LT(coarse.distance, 0.05 * extent(shape.mesh)) << shape.name;
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

TEST(CoarseMesh, IsTheSameEachTime) {
  const Mesh fine = bumpy_ball(4);
  const CoarseMesh one = coarsen(fine, 300).value(), other = coarsen(fine, 300).value();
  EXPECT_EQ(one.mesh.vertices, other.mesh.vertices);
  EXPECT_EQ(one.mesh.triangles, other.mesh.triangles);
}

TEST(Embedding, HoldsEachVertexOnItsOwnSideOfAThinWall) {
  const Mesh ball = icosphere(4, 1);
  Mesh flat = ball;
  for (glm::dvec3& v : flat.vertices) v.y *= 0.02;
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

TEST(Embedding, TakesScratchThatOtherMeshesHaveUsed) {
  Embedding::Scratch scratch;
  for (const std::size_t vertices : {300, 600, 200}) {
    const CoarseMesh coarse = coarsen(bumpy_ball(4), vertices).value();
    EXPECT_EQ(placed(coarse, coarse.mesh.vertices, scratch), placed(coarse, coarse.mesh.vertices));
  }
}

/// Worlds of bodies whose mesh is a file of 2,562 vertices.
class FineBody : public testing::Test {
 protected:
  Scene scene(std::size_t resolution, int bodies, const char* surface = "surface") {
    std::string text;
    const Mesh mesh = bumpy_ball(4);
    for (const glm::dvec3& v : mesh.vertices) text += vertex(v);
    for (const auto& [a, b, c] : mesh.triangles) text += face({int(a) + 1, int(b) + 1, int(c) + 1});
    folder_.write("ball.obj", text);
    std::string toml = "[collision]\ntolerance = 0.05\ncontact_surface = \"" + std::string(surface) +
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
}

TEST_F(FineBody, IsSimulatedItselfIfItHasNoMoreVertices) {
  const World world(scene(2562, 1), {});
  EXPECT_FALSE(world.model(0).fine);
  EXPECT_EQ(world.simulated().positions.x.data(), world.positions().x.data());
}

TEST_F(FineBody, IsMovedByContactsOfItsCoarseSurface) {
  for (const char* surface : {"surface", "vertex-vertex"}) {
    World world(scene(400, 2, surface), {});
    for (int frame = 0; frame < 240; ++frame) world.step();
    collide::surface::Surfaces surfaces;
    double distance = 0;
    for (BodyId id = 0; id < 2; ++id) {
      surfaces.push_back(world.model(id).surface);
      distance = world.model(id).fine->imported->coarse->distance;
    }
    collide::Workers workers(1);
    const auto overlaps = collide::oracle::find_overlaps(world.simulated().positions, surfaces, workers);
    const bool by_surfaces = std::string_view(surface) == "surface";
    EXPECT_TRUE(overlaps.penetrations.empty() || !by_surfaces) << overlaps.penetrations.size();
    const collide::Frame at = world.positions();
    const float lowest = *std::ranges::min_element(at.y);
    EXPECT_NEAR(lowest, 0, distance + 0.02) << surface;
    EXPECT_GT(glm::distance(motion(world, 0).centre, motion(world, 1).centre), 0.6) << surface;
    EXPECT_LT(measure(world).max_speed, std::sqrt(2 * 9.81 * 2.2))
        << "no faster than a fall from the start: " << surface;
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

TEST_F(FineBody, GoesOnAfterASnapshotAndWithAnyThreads) {
  World world(scene(400, 2), {});
  for (int frame = 0; frame < 30; ++frame) world.step();
  const Snapshot snapshot = world.snapshot();
  for (int frame = 0; frame < 30; ++frame) world.step();
  World other(scene(400, 2), {.threads = 2});
  other.restore(snapshot);
  for (int frame = 0; frame < 30; ++frame) other.step();
  EXPECT_EQ(other.state_hash(), world.state_hash());
  EXPECT_TRUE(std::ranges::equal(other.positions().y, world.positions().y));
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
