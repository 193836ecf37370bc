#pragma once
// A scene is data: what is in the world, not how it is simulated or drawn. Written in TOML; assets/scenes/README.md
// documents the format.

#include <array>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "collide/methods.h"
#include "softbody/mesh_import.h"

namespace softbody {

/// Bad input. what() is one line: the file (and line, where there is one), what is wrong, what to do.
struct SceneError : std::runtime_error {
  /// One line, whatever names and keys it quotes: control characters become question marks.
  explicit SceneError(std::string message);
};

/// A linear spring law with a damper along the spring (Introduction of the paper: elasticity and damper).
struct SpringLaw {
  double stiffness = 0;  // N/m
  double damping_ratio =
      0;  // of the critical damping of the spring between its two particles: c = 2 zeta sqrt(k m / 2)
  bool operator==(const SpringLaw&) const = default;
};

struct Material {
  std::string name;
  double mass = 1;  // kg a body, shared equally by its particles
  SpringLaw structural{300, 0.1};
  SpringLaw bend{75, 0.1};
  SpringLaw shear{};            // quad grids only
  double gas_pressure = 0;      // Pa, absolute, of the gas at the mesh's own volume: P = gas_pressure * V0 / V
  double ambient_pressure = 0;  // Pa, absolute, outside
  double internal_damping = 0;  // 1/s, rate at which a body's motion becomes rigid
  double rebound_speed = 0;  // m/s: solids throw a body back no faster than this or their restitution does; 0: no limit
  double thickness = 0.005;  // m: particles keep this far from solids, so that the faces between them stay outside
  double friction = 0.5;     // Coulomb, against other bodies
  double restitution = 0;    // 0..1, Newton's, of surface contact between bodies
  double rolling_resistance = 0.02;  // torque = this * radius * normal force, against solids
  double contact_stiffness = 100;    // N/m of the shield, summed over one particle's contacts
  /// Hz with which a lone particle swings about its place in the mesh's own shape (shape_matching.h); 0: springs and
  /// gas alone. Not given: mesh_file_shape_frequency for meshes from files, 0 for others.
  std::optional<double> shape_frequency;
  bool start_in_equilibrium = true;  // springs and gas are brought into balance when the scene is loaded
  bool operator==(const Material&) const = default;
};

inline constexpr double mesh_file_shape_frequency = 10;  // Hz

struct MeshSource {
  std::string kind = "icosphere";
  int subdivisions = 2;                            // icosphere
  double radius = 0.5;                             // m, icosphere
  int columns = 32, rows = 32;                     // grid
  double width = 3, depth = 3;                     // m, grid
  MeshFile file{};                                 // file
  std::shared_ptr<const ImportedMesh> imported{};  // file: what was read, shared by all bodies of it
  /// Reads the file. Throws ObjError.
  static MeshSource from_file(const MeshFile& file);
  Mesh make() const;
  std::uint64_t vertex_count() const;  // of the mesh, without making it
  bool operator==(const MeshSource&) const = default;
};

struct BodySource {
  MeshSource mesh;
  int material = 0;              // index into Scene::materials
  glm::dvec3 position{0, 3, 0};  // m, of the mesh's origin
  glm::dvec3 velocity{0.0};      // m/s
  int appear = 0;                // the frame in which it joins the scene ...
  int release = 0;               // ... held in place until this one
  bool operator==(const BodySource&) const = default;
};

// Solids do not move. friction: Coulomb's coefficient. restitution (0 to 1): the share of its normal speed with which a
// particle that hits the solid is thrown back (Newton); slow ones are not, see impact_speed in kernels.h.
struct SolidSphere {
  glm::dvec3 centre{0.0};  // m
  double radius = 1;       // m
  double friction = 0.5;
  double restitution = 0;
  bool operator==(const SolidSphere&) const = default;
};

/// Everything below an unbounded plane.
struct SolidPlane {
  glm::dvec3 point{0.0};       // m, anywhere on it
  glm::dvec3 normal{0, 1, 0};  // unit, out of the solid
  double friction = 0.5;
  double restitution = 0;
  bool operator==(const SolidPlane&) const = default;
};

struct SolidBox {
  glm::dvec3 centre{0.0};     // m
  glm::dvec3 half_size{0.5};  // m, along its own axes
  glm::dmat3 axes{1.0};       // columns: those axes in the world, orthonormal
  double friction = 0.5;
  double restitution = 0;
  bool operator==(const SolidBox&) const = default;
};

/// All points within a radius of a line segment.
struct SolidCapsule {
  glm::dvec3 from{-0.5, 0, 0}, to{0.5, 0, 0};  // m, ends of the segment
  double radius = 0.25;                        // m
  double friction = 0.5;
  double restitution = 0;
  bool operator==(const SolidCapsule&) const = default;
};

/// The plane y = height.
struct Ground {
  double height = 0;  // m
  double friction = 0.6;
  double restitution = 0;
  bool operator==(const Ground&) const = default;
};

/// Where "drop another body" puts it: a body source and the radius of the disc around its position.
struct Dropper {
  BodySource body;
  double spread = 0.3;  // m
  bool operator==(const Dropper&) const = default;
};

struct SleepRule {
  double speed = 0.03;  // m/s: no particle of a contact island faster ...
  int frames = 30;      // ... for this many frames
  bool operator==(const SleepRule&) const = default;
};

struct View {
  glm::dvec3 target{0, 0.8, 0};
  double distance = 8;    // m
  double azimuth = 30;    // degrees
  double elevation = 18;  // degrees
  bool operator==(const View&) const = default;
};

struct Caption {
  int frame;
  std::string text;
  bool operator==(const Caption&) const = default;
};

/// What keeps bodies apart.
enum class ContactSurface {
  vertices,  // the paper's tolerance force between the vertices that the detector finds (§2.3)
  surfaces,  // vertices against faces and edges against edges
};
struct ContactSurfaceInfo {
  ContactSurface value;
  std::string_view key, name, summary;
};
inline constexpr std::array<ContactSurfaceInfo, 2> contact_surfaces{{
    {ContactSurface::vertices, "vertex-vertex", "Vertex-vertex",
     "The paper's: vertices closer than the tolerance push each other apart (\u00a72.3)."},
    {ContactSurface::surfaces, "surface", "Surface",
     "Vertices against faces and edges against edges: the true surfaces never meet."},
}};
/// nullptr if there is none with this key.
const ContactSurfaceInfo* find_contact_surface(std::string_view key);
std::string contact_surface_keys();

struct Scene {
  std::string key;  // the file's stem
  std::string name;
  std::string look_at;              // one sentence: what to look at
  glm::dvec3 gravity{0, -9.81, 0};  // m/s^2
  std::string method{collide::default_method};
  ContactSurface contact_surface = ContactSurface::vertices;
  collide::Settings collision;  // cell_size is filled in by the world if `default_cell_size`
  bool default_cell_size = true;
  std::vector<Material> materials;
  std::vector<BodySource> bodies;
  std::vector<SolidSphere> spheres;
  std::vector<SolidPlane> planes;
  std::vector<SolidBox> boxes;
  std::vector<SolidCapsule> capsules;
  std::optional<Ground> ground;
  std::optional<Dropper> dropper;
  SleepRule sleep;
  View view;
  std::vector<Caption> captions;  // what to see from this frame on
  bool operator==(const Scene&) const = default;
};

/// Reads a scene file. `presets`: a file of materials that the scene may name; it is read only if the scene does.
/// Throws SceneError; unknown keys, wrong types and values out of range are errors too.
Scene load_scene(const std::filesystem::path& file, const std::filesystem::path& presets = {});

/// Reads a file of materials, each with a name of its own. Throws SceneError as load_scene() does.
std::vector<Material> load_presets(const std::filesystem::path& file);

/// Returns the presets of the scenes in `folder`.
std::filesystem::path presets_path(const std::filesystem::path& folder);

/// The keys of a folder's scenes (stems of its .toml files), in order.
std::vector<std::string> scene_keys(const std::filesystem::path& folder);

/// The file of a scene that is named by key in `folder`, or by path if `name` ends in .toml. Throws SceneError for an
/// unknown key; the message lists the known ones.
std::filesystem::path scene_path(const std::string& name, const std::filesystem::path& folder);

/// Loads the scene of that name, with presets_path(folder). Throws SceneError.
Scene find_scene(const std::string& name, const std::filesystem::path& folder);

}  // namespace softbody
