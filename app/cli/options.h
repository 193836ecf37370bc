#pragma once
// Parses the command line into plain values. Everything is checked here, once, before anything runs.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "app/base/usage_error.h"
#include "app/compare/difference.h"
#include "app/files/body_file.h"
#include "app/files/playback.h"
#include "app/report/report.h"
#include "collide/methods.h"
#include "softbody/integrate/integrators.h"
#include "softbody/scene/scene.h"

namespace app::cli {

enum class Command { demo, simulate, detect, report, list, new_method };

/// The options of detection. For an option that is not given, the scene or the default decides.
struct DetectionOptions {
  std::optional<std::string> method{};
  std::optional<int> levels{};
  std::optional<std::uint32_t> buckets{};
  std::optional<std::string> cell_size{};  // "S", "X,Y,Z" in metres or "auto", as typed
  std::optional<double> tolerance{};       // m
  std::optional<std::string> primes{};     // "A,B,C", as typed
};

/// The options of `detect` alone.
struct DetectOptions {
  std::vector<std::string> files;                 // meshes, at least one
  std::optional<files::BodiesBy> by;              // what a body is; otherwise the format's default
  std::optional<std::string> rest;                // mesh: pairs closer than the tolerance in it are not self-collisions
  std::optional<std::filesystem::path> contacts;  // the CSV file to write
  bool continuous = false;                        // of two files: what meets on the way from one to the other
  bool self_collision = true;
  int repeat = 1;
  bool reuse = true;  // a detector may use data of earlier frames
};

struct Options {
  Command command = Command::demo;
  std::string scene = "drop";
  bool scene_given = false;
  DetectionOptions detection;
  std::optional<std::string> contact_surface;  // a key; otherwise the scene's
  std::optional<bool> self_collision;          // otherwise the scene's
  std::optional<softbody::View> view;          // otherwise the scene's
  DetectOptions detect;
  report::ReportOptions report;
  softbody::IntegratorChoice integrator;
  std::vector<Options> beside;  // none, or one: what the second world does otherwise; other members do not count
  int threads = 1;
  double frame_time = 1.0 / 60.0;   // s
  std::optional<glm::ivec2> size;   // pixels, of pictures and the window; otherwise the window has its last one
  std::vector<std::string> guests;  // files with methods of the user's own
  std::vector<std::string> meshes;  // mesh files to open in the window
  std::vector<std::string> play;    // mesh files that the window plays as frames, in place of a scene
  std::optional<files::BodiesBy> bodies_by;  // what a body of them is; otherwise the format's default
  int frames = 800;
  std::vector<int> captures;                       // frames to take pictures of, ascending
  std::optional<std::filesystem::path> animation;  // the animated image to write
  std::optional<int> obj_every;                    // write the bodies of every so many frames as OBJ files
  std::filesystem::path out = ".";
  bool out_given = false;  // the folder is to be there even if the run writes nothing
  bool json = false;
  bool json_lines = false;           // `simulate`: a line of JSON for each frame, and one at the end
  bool oracle = false;               // `simulate` with JSON: add the surface oracle's figures of each frame
  std::string list_of;               // "scenes", "methods", "integrators", "contact-surfaces"; empty: all
  std::filesystem::path new_method;  // the source to write

  glm::ivec2 picture_size() const { return size.value_or(glm::ivec2(1280, 720)); }
};

/// Returns the chosen method, or the one with the key `otherwise`. Throws UsageError if there is no such method.
const collide::Method& chosen_method(const DetectionOptions& options, std::string_view otherwise);

/// Applies the other options to `settings`. Throws UsageError with the option at fault. Precondition: problem(settings)
/// is empty.
void apply(const DetectionOptions& options, collide::Settings& settings);

/// Returns a line for each setting that is allowed but spoils this method: today those of the hash, if it has one.
std::vector<std::string> warnings(const collide::Method& method, const collide::Settings& settings);

/// Returns how many frames of this length (s) each picture of an animation stands for: the fewest that last 1/30 s, so
/// that the animation runs in real time.
int frames_per_picture(double frame_time);

/// Returns the options; nothing if help or the version was asked for and has been printed. Throws UsageError.
std::optional<Options> parse_options(int argc, const char* const* argv);

/// Applies the options of scenes. Throws UsageError.
void apply(const Options& options, softbody::Scene& scene);

/// Returns the scene that the options name, or the recording in their files, with their settings. Throws UsageError,
/// SceneError or MeshFileError.
files::Opened open(const Options& options);

/// Returns how the second world is simulated beside this first one; nothing if none is asked for. Throws UsageError.
std::optional<compare::HowSimulated> second_world(const Options& options, const softbody::Scene& first);

}  // namespace app::cli
