// Saved scenes: what is written reads back to an equal scene, to the bit, whatever is in it.

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "softbody/mechanics/material_keys.h"
#include "softbody/scene/scene.h"
#include "tests/softbody/helpers.h"
#include "tests/softbody/obj_lines.h"

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
    auto& [mesh, material, position, axes, velocity, spin, appear, release, holds] = v;
    set_all(mesh, position, axes, velocity, spin);
    material = static_cast<int>(random_() % materials);
  }
  void set(BodySource& v) {
    set_body(v);
    set_all(v.appear, v.release, v.holds);
    v.release += v.appear;
    for (Hold& hold : v.holds) hold.until += v.appear + hold.from;
  }
  void set(Spin& v) {
    auto& [axis, degrees_per_second] = v;
    set_all(axis, degrees_per_second);
    axis = glm::normalize(axis);
  }
  void set(Hold& v) {
    auto& [where, vertices, from, until, velocity, turn, through] = v;
    set_all(from, until, velocity, turn, through);
    if (random_() % 3 == 0) {
      for (int i = 0; i < 3; ++i) vertices.push_back(static_cast<Index>(random_() % 1000));
      return;
    }
    if (random_() % 2 == 0) where = SolidSphere();
    Solid shape{where};
    shape.values([this](const char*, auto value) { set_value(value); });
    where = shape.shape;
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
  void set_value(solid::Axes v) { set(v.value); }
  void set(glm::dmat3& v) {
    glm::dvec3 axis;
    set(axis);
    v = glm::dmat3(glm::rotate(glm::dmat4(1.0), 100 * axis.x, glm::normalize(axis)));
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
    auto& [key, name, look_at, gravity, wind, method, surface, collision, list, bodies, solids, dropper, sleep, view,
           captions] = v;
    set_all(name, look_at, gravity, wind, surface, collision, list, bodies, solids, dropper, sleep, view, captions);
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

TEST(SavedScene, NamesMeshFilesRelativeToItsFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "meshes");
  std::filesystem::create_directories(folder.path() / "scenes");
  const MeshFile file{.path = folder.write("meshes/a \"b\".obj", tetrahedron),
                      .size = 0.7,
                      .weld = 2e-6,
                      .up = {0, 0, 1},
                      .resolution = min_resolution};
  Scene scene;
  scene.materials.emplace_back();
  scene.bodies.emplace_back().mesh = MeshSource::from_file(file);
  const std::string text = scene_toml(scene, folder.path() / "scenes");
  EXPECT_NE(text.find(R"("../meshes/a \"b\".obj")"), std::string::npos) << text;
  EXPECT_NE(text.find("tolerance = 0.1\n"), std::string::npos) << "numbers in their shortest form: " << text;
  const Scene found = load_scene(folder.write("scenes/saved.toml", text));
  MeshFile written = found.bodies[0].mesh.file;
  EXPECT_TRUE(std::filesystem::equivalent(written.path, file.path));
  written.path = file.path;
  EXPECT_EQ(written, file);
  EXPECT_EQ(found.bodies[0].mesh.imported->mesh.vertices, scene.bodies[0].mesh.imported->mesh.vertices);
}

TEST(SavedScene, RefusesWhatNoFileCanHold) {
  Scene scene;
  const auto save = [&] { scene_toml(scene, "/"); };
  scene.materials.resize(1);
  expect_error("without a body", save);
  scene.bodies.emplace_back();
  EXPECT_EQ(error_of(save), "was taken");
  scene.materials.resize(2);
  expect_error("two materials", save);
  scene.materials.resize(1);
  scene.name = "\xff";
  expect_error("cannot be written", save);
}

}  // namespace THIS_FILE
}  // namespace softbody::test
