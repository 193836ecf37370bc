#pragma once
// A scene is data: it says what is in the world, not how that is simulated or drawn. It is written in TOML;
// assets/scenes/README.md documents the format.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

#include "collide/methods.h"
#include "softbody/contact/solid.h"
#include "softbody/mesh/mesh_import.h"
#include "softbody/model/material.h"
#include "softbody/model/scene_error.h"

namespace softbody {

/// A rotation that goes on.
struct Spin {
  glm::dvec3 axis{0, 1, 0};       // unit
  double degrees_per_second = 0;  // counter-clockwise, seen from the axis' tip
  glm::dvec3 vector() const { return glm::radians(degrees_per_second) * axis; }  // rad/s
  bool operator==(const Spin&) const = default;
};

/// Holds the vertices of a body that are in a shape where it appears, its surface included.
struct Hold {
  Solid::Shape where = SolidBox{};
  std::vector<Index> vertices{};  // if not empty, in place of those: of the mesh that is simulated
  int from = 0;                   // the frame in which it begins, if the body is there
  int until = 0;                  // the frame in which it lets them go; 0: never
  glm::dvec3 velocity{0.0};       // m/s, with which it moves them ...
  Spin turn{};                    // ... and turns them, about an axis through a place that moves with them:
  glm::dvec3 through{0.0};        // m
  bool operator==(const Hold&) const = default;
};

struct BodySource {
  MeshSource mesh;
  int material = 0;              // index into Scene::materials
  glm::dvec3 position{0, 3, 0};  // m, of the mesh's origin
  glm::dmat3 axes{1.0};          // columns: the mesh's axes in the world, orthonormal; it turns about its origin
  glm::dvec3 velocity{0.0};      // m/s, of its middle ...
  Spin spin{};                   // ... about which it spins
  int appear = 0;                // the frame in which it joins the scene ...
  int release = 0;               // ... held in place until this one
  std::vector<Hold> holds{};
  bool operator==(const BodySource&) const = default;
};

/// What "drop another body" adds, and where: anywhere on a disc around the position of `body`.
struct Dropper {
  BodySource body;
  double spread = 0.3;  // m, radius of the disc
  bool operator==(const Dropper&) const = default;
};

struct SleepRule {
  double speed = 0.03;  // m/s: an island of touching bodies falls asleep if no particle of it was faster ...
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
/// Returns nullptr if there is none with this key.
const ContactSurfaceInfo* find_contact_surface(std::string_view key);
std::string contact_surface_keys();

struct Scene {
  std::string key;  // the file's stem
  std::string name;
  std::string look_at;              // one sentence for the user: what to look at
  glm::dvec3 gravity{0, -9.81, 0};  // m/s^2
  glm::dvec3 wind{0.0};             // m/s, of the air
  std::string method{collide::default_method};
  ContactSurface contact_surface = ContactSurface::vertices;
  collide::Settings collision;  // without a cell size: the automatic one
  std::vector<Material> materials;
  std::vector<BodySource> bodies;
  std::vector<Solid> solids;  // a step handles them in this order
  std::optional<Dropper> dropper;
  SleepRule sleep;
  View view;
  std::vector<Caption> captions;  // what to see from this frame on
  bool operator==(const Scene&) const = default;
};

/// Returns an empty string if all values of the scene and its materials are within the limits of a scene file, else one
/// line that names the value and what is allowed.
std::string problem(const Scene& scene);

/// Reads a scene file. `presets`: a file of materials that the scene may name; it is read only if the scene does.
/// Throws SceneError; unknown keys, wrong types and values out of range are errors too.
Scene load_scene(const std::filesystem::path& file, const std::filesystem::path& presets = {});

/// Reads the text of a scene file, which may have no body yet. `file` names it in messages, and its folder is that of
/// the meshes that the text names. Throws SceneError as load_scene() does.
Scene parse_scene(std::string_view text, const std::filesystem::path& file, const std::filesystem::path& presets = {});

/// Returns the text of a scene file, the inverse of load_scene(). If the file is put into `folder`, that reads it back
/// to an equal scene. Mesh files are named relative to `folder`; their contents are not written. The scene's key is the
/// name of the file, so it is not in the text. Throws SceneError if no scene file can hold the scene: it has no body
/// and no dropper, two materials have the same name, a text is not UTF-8, or the result is larger than
/// max_toml_file_size.
std::string scene_toml(const Scene& scene, const std::filesystem::path& folder);

/// Reads a file of materials, each with a name of its own. Throws SceneError as load_scene() does.
std::vector<Material> load_presets(const std::filesystem::path& file);

/// Returns the presets of the scenes in `folder`.
std::filesystem::path presets_path(const std::filesystem::path& folder);

/// Returns the keys of a folder's scenes (the stems of its .toml files), in order.
std::vector<std::string> scene_keys(const std::filesystem::path& folder);

/// Returns the file of a scene. `name` is its path if it ends in .toml, else its key in `folder`. Throws SceneError for
/// an unknown key; the message lists the known ones.
std::filesystem::path scene_path(const std::string& name, const std::filesystem::path& folder);

/// Loads the scene of that name, with presets_path(folder). Throws SceneError.
Scene find_scene(const std::string& name, const std::filesystem::path& folder);

}  // namespace softbody
