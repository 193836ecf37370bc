#pragma once
// Simulates soft bodies:
//
//   sbcollide::Scene scene;
//   scene.add_ground();
//   scene.add_body({.mesh = scene.add_sphere_mesh(0.5), .position = {0, 2, 0}});
//   sbcollide::World world(scene);
//   for (int i = 0; i < 100; ++i) world.step();
//   use(world.positions().x);
//
// Lengths are in metres, times in seconds, masses in kilograms; y points up. Objects may work on several threads at the
// same time, each on one of them. Worlds share the models of equal bodies, which never change, by a list behind a lock.
// Equal scenes move equally, to the bit, on any number of threads and on any processor; with meshes that ride on fewer
// particles, for equal versions of meshoptimizer.

#include <filesystem>
#include <map>
#include <string_view>

#include <sbcollide/collide.h>

namespace sbcollide {

using Vector = std::array<double, 3>;

/// A body of a scene.
struct Body {
  int mesh = 0;               // what add_mesh() or add_sphere_mesh() of its scene returned
  std::string material = {};  // the name of a material of the scene; empty: the first, or default values if it has none
  Vector position = {};       // of the mesh's origin
  Vector velocity = {};       // m/s
  int appear = 0;             // the frame in which it joins the scene
};

/// What is in a world at the start. The functions below only collect it: the constructor of World checks it.
class Scene {
 public:
  /// An empty scene with gravity. materials: a file of materials, from which presets are taken; the one that is
  /// installed is PREFIX/share/sbcollide/assets/materials.toml.
  explicit Scene(const std::filesystem::path& materials = {});
  /// Reads a scene file (its format: PREFIX/share/sbcollide/assets/scenes/README.md). Presets come from materials.toml
  /// in the folder above. Throws Error if the file cannot be read.
  static Scene from_file(const std::filesystem::path& file);
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  /// Adds tables as scene files have them, such as "[sleep]\nspeed = 0.05\n".
  void add_text(std::string_view toml);
  /// Throws Error beyond 1000 m/s^2 along an axis.
  void set_gravity(const Vector& metres_per_second_squared);

  /// Adds a material. values: by the keys that scene files have, such as {"structural.stiffness", 300}; what is left
  /// out comes from the preset or, without one, is the default. Throws Error for a key that does not exist.
  void add_material(std::string_view name, const std::map<std::string, double>& values = {},
                    std::string_view preset = {});

  // Solids. They do not move. Throw Error for numbers that are not finite.
  void add_ground(double height = 0, double friction = 0.6);
  void add_solid_plane(const Vector& point, const Vector& normal, double friction = 0.5);
  void add_solid_sphere(const Vector& centre, double radius, double friction = 0.5);
  void add_solid_box(const Vector& centre, const Vector& size, double friction = 0.5);
  void add_solid_capsule(const Vector& from, const Vector& to, double radius, double friction = 0.5);

  /// Adds a mesh for bodies and returns its number. The order of vertices and triangles stays. xyz: three coordinates
  /// of each vertex; the middle of their bounding box becomes the mesh's origin. Each edge must have one or two
  /// triangles, each vertex at least one; triangles are turned if their neighbours or the volume ask for it.
  /// resolution: about so many particles simulate the mesh if it has more vertices, which then ride on them; 50 or
  /// more. 0: 800, if it has more than 1,000 vertices. Throws Error.
  int add_mesh(std::span<const float> xyz, std::span<const std::array<Index, 3>> triangles, int resolution = 0);
  /// Adds an icosphere of 10 * 4^subdivisions + 2 vertices. Throws Error.
  int add_sphere_mesh(double radius, int subdivisions = 2);
  void add_body(const Body& body);

 private:
  friend class World;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

struct WorldSettings {
  int threads = 1;               // 0: all cores
  double frame_time = 1.0 / 60;  // length of a step, 1e-6 to 1 s
  std::string integrator = "auto";
};

struct Positions {
  std::span<const float> x, y, z;  // one of each for every vertex, body after body
};

/// In J, without the energy that contacts store.
struct Energies {
  double kinetic = 0, elastic = 0, gas = 0, gravity = 0;
  double total() const { return kinetic + elastic + gas + gravity; }
};

class World {
 public:
  /// Throws Error if something in the scene or in the settings is not allowed.
  explicit World(const Scene& scene, const WorldSettings& settings = {});
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// Simulates one frame and finds the contacts at its end. Throws Error if there are too many of them.
  void step();
  /// Adds a body now, with a mesh and a material of the scene, and returns its number. Throws Error.
  Index add_body(const Body& body);

  // The state at the end of the last step. Spans are valid until the next step or change.
  int frame() const;  // steps done
  double time() const;
  Index bodies() const;
  Index first_vertex(Index body) const;  // throws Error if there is no such body, as triangles() does
  std::span<const std::array<Index, 3>> triangles(Index body) const;  // of the body's own vertices, counted from 0
  Positions positions() const;
  /// m/s, of each vertex; where fewer particles simulate a mesh, of the places of their surface that hold its vertices.
  std::vector<Vector> velocities() const;
  /// Pairs of vertices that are closer than the tolerance; ascending. The tolerance is 0.1 m unless the scene has
  /// another: add_text("[collision]\ntolerance = 0.05\n").
  std::span<const Contact> contacts() const;
  Energies energies() const;
  bool finite() const;               // all positions and velocities
  bool at_rest() const;              // all bodies are asleep, and none is still to come
  std::uint64_t state_hash() const;  // over the bits of positions and velocities

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sbcollide
