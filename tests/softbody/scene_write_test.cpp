// Saved scenes: what is written reads back to an equal scene, to the bit, whatever is in it.

#include <gtest/gtest.h>

#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "softbody/mechanics/material_keys.h"
#include "softbody/scene/scene.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

/// Values for fields. Nearly all limits of scene files hold between 0.01 and 0.09.
class Filler {
 public:
  explicit Filler(unsigned seed) : random_(seed) {}

  void set(double& v) { v = std::uniform_real_distribution(0.01, 0.09)(random_); }
  void set(float& v) { v = std::uniform_real_distribution(0.01f, 0.09f)(random_); }
  void set(int& v) { v = std::uniform_int_distribution(1, 6)(random_); }
  void set(std::uint32_t& v) { v = std::uniform_int_distribution(1u, 4294967295u)(random_); }
  void set(bool& v) { v = random_() % 2 == 0; }
  void set(std::string& v) {
    const std::vector<std::string> letters{"a", "\"", "\\", "\n", "\x01", "\x7f", "#", "'", "é", "字", "]", " "};
    v = std::to_string(random_());  // names differ
    for (int i = 0; i < 12; ++i) v += letters[random_() % letters.size()];
  }
  void set(glm::dvec3& v) { set_all(v.x, v.y, v.z); }
  void set(glm::vec3& v) { set_all(v.x, v.y, v.z); }

  // Each takes its struct apart: a new field does not compile until it is set here, and then must be written.
  void set(Material& v) {
    set(v.name);
    for (const Key* key : material_keys()) {
      if (key->options.is_switch)
        v[*key] = random_() % 2 == 0;
      else if (v.given(*key) || random_() % 4 != 0)
        set(v[*key]);
    }
  }
  void set(MeshSource& v) {
    auto& [kind, subdivisions, radius, columns, rows, width, depth, file, imported] = v;
    kind = random_() % 2 ? "icosphere" : "grid";  // files have a test of their own
    if (kind == "grid")
      set_all(columns, rows, width, depth);
    else
      set_all(subdivisions, radius);
  }
  void set_body(BodySource& v) {
    auto& [mesh, material, position, velocity, appear, release] = v;
    set_all(mesh, position, velocity);
    material = static_cast<int>(random_() % materials);
  }
  void set(BodySource& v) {
    set_body(v);
    set_all(v.appear, v.release);
    v.release += v.appear;
  }
  void set(Dropper& v) {
    auto& [body, spread] = v;
    set_body(body);  // it has no frame to appear in
    set_all(spread);
  }
  void set_value(auto v) { set(v.value); }
  void set_value(solid::Direction v) {
    set(v.value);
    v.value = glm::normalize(v.value);
  }
  void set_value(solid::Axes v) {
    glm::dvec3 axis;
    set(axis);
    v.value = glm::dmat3(glm::rotate(glm::dmat4(1.0), 100 * axis.x, glm::normalize(axis)));
  }
  void set(Solid& v) {
    auto& [shape, friction, restitution, enabled] = v;
    set_all(friction, restitution, enabled);
    v.values([this](const char*, auto value) { set_value(value); });
  }
  void set(std::vector<Solid>& v) {
    v = {{SolidSphere()}, {SolidSphere()}, {Ground()},       {SolidPlane()},  {SolidPlane()},
         {SolidBox()},    {SolidBox()},    {SolidCapsule()}, {SolidCapsule()}};
    if (random_() % 4 == 0) std::erase_if(v, tests::has_shape<Ground>);
    for (Solid& solid : v) set(solid);
  }
  void set(SleepRule& v) {
    auto& [speed, frames] = v;
    set_all(speed, frames);
  }
  void set(View& v) {
    auto& [target, distance, azimuth, elevation] = v;
    set_all(target, distance, azimuth, elevation);
  }
  void set(Caption& v) {
    auto& [frame, text] = v;
    set_all(frame, text);
  }
  void set(collide::Settings& v) {
    auto& [tolerance, self_collision, levels, buckets, cell_size, primes] = v;
    set_all(tolerance, self_collision, levels, cell_size, primes[0], primes[1], primes[2]);
    buckets = 1 + static_cast<std::uint32_t>(random_() % collide::max_buckets);
  }
  void set(ContactSurface& v) { v = contact_surfaces[random_() % contact_surfaces.size()].value; }
  void set(Scene& v) {
    auto& [key, name, look_at, gravity, method, surface, collision, list, bodies, solids, dropper, sleep, view,
           captions] = v;
    set_all(name, look_at, gravity, surface, collision, list, bodies, solids, dropper, sleep, view, captions);
    key = "saved";
    method = collide::method_table()[random_() % collide::method_table().size()].key;
  }

 private:
  static constexpr std::size_t materials = 3;

  template <class... Fields>
  void set_all(Fields&... fields) {
    (set(fields), ...);
  }
  template <class Item>
  void set(std::vector<Item>& list) {
    list.resize(materials);
    for (Item& item : list) set(item);
  }
  template <class Item>
  void set(std::optional<Item>& item) {
    if (random_() % 4 != 0) set(item.emplace());
  }

  std::mt19937 random_;
};

/// The scene as saved in a folder and read again.
Scene again(const Scene& scene, const TemporaryFolder& folder) {
  return load_scene(folder.write("saved.toml", scene_toml(scene, folder.path())));
}

void expect_equal(const Scene& expected, const Scene& found, const TemporaryFolder& folder) {
  EXPECT_EQ(scene_toml(found, folder.path()), scene_toml(expected, folder.path()));  // shows where
  EXPECT_TRUE(found == expected);
}

TEST(SavedScene, WithRandomValuesInEveryFieldReadsBackEqual) {
  const TemporaryFolder folder;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Scene scene;
    Filler(seed).set(scene);
    expect_equal(scene, again(scene, folder), folder);
  }
}

/// The same mesh file by two names is the same file; what was read from it is compared, not where it lies in memory.
void unite_files(Scene& scene, const Scene& with) {
  std::vector<std::pair<MeshSource*, const MeshSource*>> pairs;
  for (std::size_t i = 0; i < std::min(scene.bodies.size(), with.bodies.size()); ++i)
    pairs.emplace_back(&scene.bodies[i].mesh, &with.bodies[i].mesh);
  if (scene.dropper && with.dropper) pairs.emplace_back(&scene.dropper->body.mesh, &with.dropper->body.mesh);
  for (const auto& [mesh, other] : pairs) {
    if (!mesh->imported) continue;
    ASSERT_TRUE(other->imported);
    EXPECT_TRUE(std::filesystem::equivalent(mesh->file.path, other->file.path));
    EXPECT_EQ(mesh->imported->mesh.vertices, other->imported->mesh.vertices);
    EXPECT_EQ(mesh->imported->mesh.triangles, other->imported->mesh.triangles);
    EXPECT_EQ(mesh->imported->findings, other->imported->findings);
    mesh->file.path = other->file.path;
    mesh->imported = other->imported;
  }
}

TEST(SavedScene, OfEveryShippedOneReadsBackEqual) {
  const TemporaryFolder folder;
  const auto keys = scene_keys(SBCOLLIDE_SCENES);
  ASSERT_FALSE(keys.empty());
  for (const std::string& key : keys) {
    SCOPED_TRACE(key);
    const Scene scene = find_scene(key, SBCOLLIDE_SCENES);
    Scene found = again(scene, folder);
    found.key = key;
    unite_files(found, scene);
    expect_equal(scene, found, folder);
  }
}

TEST(SavedScene, MovesLikeTheOneItWasSavedFrom) {
  const TemporaryFolder folder;
  for (const char* key : {"star", "container"}) {
    World first(find_scene(key, SBCOLLIDE_SCENES), {}), second(again(first.scene(), folder), {});
    for (int i = 0; i < 20; ++i) first.step(), second.step();
    EXPECT_EQ(first.state_hash(), second.state_hash()) << key;
  }
}

TEST(SavedScene, NamesMeshFilesRelativeToItsFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "meshes");
  std::filesystem::create_directories(folder.path() / "scenes");
  MeshFile file;
  file.path =
      folder.write("meshes/a \"b\".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  file.size = 0.7;
  file.up = {0, 0, 1};
  Scene scene;
  scene.materials.emplace_back();
  scene.bodies.emplace_back().mesh = MeshSource::from_file(file);
  const std::string text = scene_toml(scene, folder.path() / "scenes");
  EXPECT_NE(text.find(R"("../meshes/a \"b\".obj")"), std::string::npos) << text;
  Scene found = load_scene(folder.write("scenes/saved.toml", text));
  unite_files(found, scene);
  EXPECT_TRUE(found.bodies == scene.bodies);
}

std::string error_of(const Scene& scene) {
  try {
    scene_toml(scene, "/");
  } catch (const SceneError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "was taken";
}

TEST(SavedScene, RefusesWhatNoFileCanHold) {
  Scene scene;
  scene.materials.resize(1);
  EXPECT_NE(error_of(scene).find("without a body"), std::string::npos) << error_of(scene);
  scene.bodies.emplace_back();
  EXPECT_EQ(error_of(scene), "was taken");
  scene.materials.resize(2);
  EXPECT_NE(error_of(scene).find("two materials"), std::string::npos) << error_of(scene);
  scene.materials.resize(1);
  scene.name = "\xff";
  EXPECT_NE(error_of(scene).find("cannot be written"), std::string::npos) << error_of(scene);
}

TEST(SavedScene, HasNumbersInTheirShortestForm) {
  Scene scene;
  scene.materials.resize(1);
  scene.bodies.emplace_back();
  scene.collision.tolerance = 0.1f;
  EXPECT_NE(scene_toml(scene, "/").find("tolerance = 0.1\n"), std::string::npos);
}

}  // namespace THIS_FILE
}  // namespace softbody::test
