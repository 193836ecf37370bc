#pragma once
// Imports the user's own meshes, scenes and recorded frames: named or dropped on the window, read beside the demo, and
// reported on.

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "app/base/background.h"
#include "app/session/body_controls.h"
#include "app/session/scene_controls.h"

namespace app::session {

/// Reads a file, and makes its body or world, in parts. A task for Background.
class FileReader {
 public:
  struct SceneToRead {
    std::filesystem::path path, presets;
  };
  using FramesToRead = std::vector<std::filesystem::path>;
  struct Mesh {
    softbody::MeshSource mesh;
    std::shared_ptr<const softbody::BodyModel> model;  // of imported_material(); kept alive so that a world finds it
  };
  struct World {
    std::filesystem::path path;  // of the scene, or of the first frame
    std::string what;            // the report
    files::Opened opened;
    ShownWorld shown;
    std::optional<Mesh> lone{};  // whose lone_scene() it is
  };
  struct Stage {  // that was begun; the answer is not whole yet
    std::string name;
  };
  struct Question {
    std::variant<softbody::MeshFile, SceneToRead, FramesToRead> file;
    int threads = 1;                               // of the world
    std::function<void(softbody::Scene&)> lone{};  // of a mesh that opens in its lone_scene(): changes that
    softbody::IntegratorChoice integrator{};       // of lone_scene()
  };
  using Answer = std::variant<Stage, Mesh, World, std::string>;  // string: what failed; empty if it was cancelled
  std::optional<Answer> advance(const Question& question, Background<FileReader>& background);

 private:
  std::optional<softbody::ImportedMesh> fine_;  // a mesh without its coarse mesh
  std::optional<Answer> read_;                  // a mesh, perhaps without its model; or what has not been shown
};

/// Returns a body of this mesh, which must be imported, placed above the middle of the scene, clear of solids and
/// bodies.
softbody::BodySource place_above(const softbody::BodiesInMotion& world, softbody::MeshSource mesh);

/// Returns a scene in which a body of this mesh, which must be imported, falls on the ground and nothing else is there.
/// The camera shows it large.
softbody::Scene lone_scene(softbody::MeshSource mesh);

/// Returns the material of an imported body of this extent (m): springs, and shape matching instead of gas, which
/// cannot keep a concave or open mesh in shape. It swings and bends like a body of 1 m and 1 kg, but a larger body
/// weighs more.
softbody::Material imported_material(double extent);

class Import {
 public:
  /// The report on one file: what was found and changed, or why it was refused.
  struct FileReport {
    std::string text;
    bool refused = false;
  };
  struct JoinedAt {
    glm::dvec3 centre;
    double radius;  // m
  };
  static constexpr float min_size = 0.05f, max_size = 20;   // m
  static constexpr double min_weld = 1e-7, max_weld = 0.1;  // times a mesh's size

  /// They must outlive this.
  Import(Simulation& simulation, SceneControls& scenes, BodyControls& bodies)
      : simulation_(simulation), scenes_(scenes), bodies_(bodies) {}

  std::string path;                         // OBJ, PLY or TOML
  float size = 1;                           // m, the largest extent that a mesh is scaled to
  double weld = softbody::MeshFile{}.weld;  // times the size, see softbody::MeshFile
  bool z_is_up = false;                     // in the file; else y is up
  std::size_t resolution = 0;               // of particles, see softbody::MeshFile
  /// What the command line wants of a lone_scene().
  std::function<void(softbody::Scene&)> lone_options = [](softbody::Scene&) {};

  /// Begins to read the file of `path`, which then replaces the present scene: a mesh opens in lone_scene(). problem()
  /// says why a file is refused.
  void load();
  /// Does the same with files that were dropped on the window, one after another; but meshes behind the first one or
  /// behind a scene join it, and if `into_scene`, all join the present scene. report() says why one is refused. If they
  /// are meshes that fit together as frames, question() asks first whether to play them; what an export of motion
  /// writes beside them is no frame. Files that are dropped meanwhile wait for the answer.
  void drop(const std::vector<std::string>& files, bool into_scene = false);
  /// Takes what has been read, and begins with the next file that waits. Call it once a frame.
  void update();
  /// Lets `elapsed` seconds of real time pass. Reports go after a while, but refusals stay.
  void age(double elapsed);
  /// Returns a sphere around the place where the last mesh has joined the scene, which may be out of sight, if one has
  /// since the last call.
  std::optional<JoinedAt> take_joined() { return std::exchange(joined_, std::nullopt); }

  /// Returns the question whether to play the files that were dropped, or to import each; empty if there is none.
  std::string question() const;
  // The answers to question().
  void play();
  void import_each();

  /// Returns true while something is read; not while question() waits for the user.
  bool busy() const { return reader_.has_work() || (!frames_ && !dropped_.empty()); }
  /// Returns what is being read, what is done with it, and for how long; empty unless busy().
  std::string progress() const;
  /// Gives up what is being read, and all files that wait. busy() until the present stage is over.
  void cancel();
  /// Returns why the file of `path` was refused; empty if it was not, or if `path` has changed since.
  std::string problem() const { return problem_.about(path); }
  /// Returns the reports since the last load(), in order: all refusals, and the last few of the others.
  const std::vector<FileReport>& report() const { return report_; }
  /// Forgets the report and the question.
  void dismiss_report() {
    report_.clear();
    frames_.reset();
    lone_.clear();
  }

  /// Returns true if the report is on meshes in a lone_scene(), and there was a scene before that they could join.
  bool can_join() const;
  /// Goes back to that scene, and lets them join. Precondition: can_join().
  void join_scene_before();

 private:
  static constexpr std::size_t max_file_reports = 5;
  static constexpr double max_report_age = 15;  // s
  struct Frames {
    std::vector<std::string> files;
    FileReader::World world;
  };

  void open();
  void open_next();
  void add(FileReport file_report);
  void refuse(const std::string& why);
  void read(decltype(FileReader::Question::file) file);
  void take(FileReader::Answer answer);
  void enter(FileReader::World answer);
  void join(FileReader::Mesh read);

  Simulation& simulation_;
  SceneControls& scenes_;
  BodyControls& bodies_;
  FieldNotice problem_;
  bool is_dropped_ = false;  // the file that is read; else load() was called
  bool joins_ = false;       // the next mesh; else it opens in a scene of its own
  std::vector<FileReport> report_;
  double report_age_ = 0;               // s
  std::vector<FileReader::Mesh> lone_;  // the meshes of the last lone_scene(), if there was a world before
  std::vector<std::string> dropped_;    // not yet loaded
  std::vector<std::string> together_;   // what is read now, if it may be frames
  std::optional<Frames> frames_;        // what question() is about
  std::optional<JoinedAt> joined_;
  std::chrono::steady_clock::time_point began_;
  std::string stage_;  // of what is read
  Background<FileReader> reader_;
};

}  // namespace app::session
