#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include <sbcollide/softbody.h>
#include <sbcollide/softbody_c.h>

#include "tests/api/recorded_bodies.h"
#include "tests/api/ring.h"

namespace api::test {
namespace THIS_FILE {

using Finder = std::unique_ptr<sbcollide_finder, decltype(&sbcollide_finder_free)>;
using World = std::unique_ptr<sbcollide_world, decltype(&sbcollide_world_free)>;

Finder make_finder() { return {sbcollide_finder_new(), &sbcollide_finder_free}; }
World make_world() { return {sbcollide_world_new(), &sbcollide_world_free}; }

bool says(const char* error, const char* words) { return std::strstr(error, words) != nullptr; }

/// Adds bodies as ContactFinder does.
struct Adder {
  sbcollide_finder* finder;
  void add_body(const sbcollide::BodyMesh& mesh) {
    EXPECT_EQ(sbcollide_finder_add_body(finder, mesh.vertices, reinterpret_cast<const uint32_t*>(mesh.triangles.data()),
                                        mesh.triangles.size(), reinterpret_cast<const uint32_t*>(mesh.edges.data()),
                                        mesh.edges.size(), mesh.rest.data()),
              SBCOLLIDE_OK);
  }
};

TEST(CFinder, FindsWhatTheDetectorsFind) {
  const RecordedBodies recorded("C", 90);
  const Finder finder = make_finder();
  Adder adder{finder.get()};
  recorded.add_to(adder);
  ASSERT_EQ(sbcollide_finder_set(finder.get(), SBCOLLIDE_TOLERANCE, 0.0625), SBCOLLIDE_OK);  // keeps the bodies
  for (const char* method : {"multi-level-sb-exact", "multi-level-sb"}) {
    ASSERT_EQ(sbcollide_finder_set_method(finder.get(), method), SBCOLLIDE_OK);
    ASSERT_EQ(sbcollide_finder_find(finder.get(), recorded.x.data(), recorded.y.data(), recorded.z.data()),
              SBCOLLIDE_OK);
    const std::vector<sbcollide::Contact> expected = recorded.contacts(method, 0.0625f);
    EXPECT_FALSE(expected.empty());
    ASSERT_EQ(sbcollide_finder_contact_count(finder.get()), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const sbcollide_contact found = sbcollide_finder_contacts(finder.get())[i];
      ASSERT_EQ((sbcollide::Contact{found.a, found.b}), expected[i]);
    }
  }
}

TEST(CFinder, KeepsWhyACallFailed) {
  const Finder finder = make_finder();
  const auto refuses = [&](sbcollide_status status, const char* words) {
    EXPECT_EQ(status, SBCOLLIDE_ERROR);
    EXPECT_TRUE(says(sbcollide_finder_error(finder.get()), words)) << sbcollide_finder_error(finder.get());
  };
  sbcollide_finder* f = finder.get();
  const std::array<uint32_t, 3> corners{0, 1, 2};
  const std::array<float, 3> zero{};
  refuses(sbcollide_finder_set(f, SBCOLLIDE_TOLERANCE, -1), "tolerance");
  refuses(sbcollide_finder_set(f, SBCOLLIDE_LEVELS, 1.5), "whole");
  refuses(sbcollide_finder_set(f, SBCOLLIDE_THREADS, 1e12), "whole");
  refuses(sbcollide_finder_set_method(f, "fast"), "brute-force");
  refuses(sbcollide_finder_set_method(f, nullptr), "NULL");
  refuses(sbcollide_finder_add_body(f, 2, corners.data(), 1, nullptr, 0, nullptr), "vertex");
  refuses(sbcollide_finder_add_body(f, 2, nullptr, 1, nullptr, 0, nullptr), "NULL");
  EXPECT_EQ(sbcollide_finder_find(f, nullptr, nullptr, nullptr), SBCOLLIDE_OK);  // of no body
  EXPECT_STREQ(sbcollide_finder_error(f), "");
  ASSERT_EQ(sbcollide_finder_add_body(f, 3, nullptr, 0, nullptr, 0, nullptr), SBCOLLIDE_OK);
  ASSERT_EQ(sbcollide_finder_find(f, zero.data(), zero.data(), zero.data()), SBCOLLIDE_OK);
  EXPECT_EQ(sbcollide_finder_contact_count(f), 3u);
  refuses(sbcollide_finder_find(f, zero.data(), nullptr, zero.data()), "NULL");
  EXPECT_EQ(sbcollide_finder_contact_count(f), 0u);
  EXPECT_EQ(sbcollide_finder_find(nullptr, nullptr, nullptr, nullptr), SBCOLLIDE_ERROR);
}

TEST(CWorld, MovesAsTheOneOfCpp) {
  sbcollide::Scene scene;
  scene.add_ground();
  scene.add_body({.mesh = scene.add_sphere_mesh(0.4), .position = {0, 1, 0}});
  sbcollide::World expected(scene);
  for (int i = 0; i < 40; ++i) expected.step();

  const World handle = make_world();
  sbcollide_world* world = handle.get();
  int mesh = -1;
  const std::array<double, 3> position{0, 1, 0};
  EXPECT_EQ(sbcollide_world_vertices(world), 0u);  // nothing is there before the start
  EXPECT_EQ(sbcollide_world_contact_count(world), 0u);
  ASSERT_EQ(sbcollide_world_add_text(world, "[ground]\nfriction = 0.6"), SBCOLLIDE_OK);
  ASSERT_EQ(sbcollide_world_add_sphere_mesh(world, 0.4, 2, &mesh), SBCOLLIDE_OK);
  ASSERT_EQ(sbcollide_world_add_body(world, mesh, nullptr, position.data(), nullptr), SBCOLLIDE_OK);
  ASSERT_EQ(sbcollide_world_start(world, 1, nullptr), SBCOLLIDE_OK);
  ASSERT_EQ(sbcollide_world_step(world, 40), SBCOLLIDE_OK);
  EXPECT_EQ(sbcollide_world_state_hash(world), expected.state_hash());
  EXPECT_EQ(sbcollide_world_energy(world), expected.energies().total());
  EXPECT_EQ(sbcollide_world_frame(world), 40);
  ASSERT_EQ(sbcollide_world_vertices(world), 162u);
  EXPECT_EQ(sbcollide_world_y(world)[7], expected.positions().y[7]);
  std::vector<double> velocities(3 * 162);
  ASSERT_EQ(sbcollide_world_velocities(world, velocities.data()), SBCOLLIDE_OK);
  EXPECT_EQ(velocities[3 * 161 + 1], expected.velocities()[161][1]);
  EXPECT_EQ(sbcollide_world_first_vertex(world, 1), 162u);
}

TEST(CWorld, TakesMeshesAsTheOneOfCpp) {
  const Ring ring;
  for (const int resolution : {0, 200}) {
    sbcollide::Scene scene;
    scene.add_body({.mesh = ring.add_to(scene, resolution)});
    const World handle = make_world();
    sbcollide_world* world = handle.get();
    int mesh = -1;
    const auto add = [&](const auto& function, auto... more) {
      return function(world, ring.xyz.data(), 1800, ring.triangles.front().data(), 3600, more..., &mesh);
    };
    ASSERT_EQ(resolution == 0 ? add(sbcollide_world_add_mesh) : add(sbcollide_world_add_fine_mesh, resolution),
              SBCOLLIDE_OK);
    ASSERT_EQ(sbcollide_world_add_body(world, mesh, nullptr, nullptr, nullptr), SBCOLLIDE_OK);
    ASSERT_EQ(sbcollide_world_start(world, 1, nullptr), SBCOLLIDE_OK);
    ASSERT_EQ(sbcollide_world_step(world, 1), SBCOLLIDE_OK);
    sbcollide::World expected(scene);
    expected.step();
    EXPECT_EQ(sbcollide_world_state_hash(world), expected.state_hash()) << resolution;
    EXPECT_EQ(sbcollide_world_vertices(world), 1800u);
  }
}

TEST(CWorld, KeepsWhyACallFailed) {
  const World handle = make_world();
  sbcollide_world* world = handle.get();
  const auto refuses = [&](sbcollide_status status, const char* words) {
    EXPECT_EQ(status, SBCOLLIDE_ERROR);
    EXPECT_TRUE(says(sbcollide_world_error(world), words)) << sbcollide_world_error(world);
  };
  int mesh = 0;
  refuses(sbcollide_world_step(world, 1), "sbcollide_world_start");
  refuses(sbcollide_world_load(world, "/nowhere.toml"), "cannot be read");
  refuses(sbcollide_world_add_sphere_mesh(world, -1, 2, &mesh), "radius");
  refuses(sbcollide_world_add_fine_mesh(world, nullptr, 0, nullptr, 0, 10, &mesh), "resolution");
  ASSERT_EQ(sbcollide_world_load(world, SBCOLLIDE_SCENES "/A.toml"), SBCOLLIDE_OK);
  ASSERT_EQ(sbcollide_world_start(world, 1, nullptr), SBCOLLIDE_OK);
  refuses(sbcollide_world_start(world, 1, "best"), "integrator");
  EXPECT_EQ(sbcollide_world_step(world, 1), SBCOLLIDE_OK);  // the first world is still there
  EXPECT_EQ(sbcollide_world_bodies(world), 3u);
  ASSERT_EQ(sbcollide_world_clear(world, nullptr), SBCOLLIDE_OK);
  ASSERT_EQ(sbcollide_world_add_text(world, "[[solid_sphere]]\nradius = -1"), SBCOLLIDE_OK);
  refuses(sbcollide_world_start(world, 1, nullptr), "radius");
}

TEST(CInterface, HasTheVersionOfTheHeader) { EXPECT_STREQ(sbcollide_version(), SBCOLLIDE_VERSION); }

}  // namespace THIS_FILE
}  // namespace api::test
