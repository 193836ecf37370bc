#pragma once
// Meshes and scenes of the user's own: named or dropped on the window, read beside the demo, reported on.

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "app/base/background_worker.h"
#include "app/session/session.h"

namespace app {

/// Reads a file and does what may take long before it can join a session, for BackgroundWorker.
struct FileReader {
  struct SceneToRead {
    std::filesystem::path path;
    int threads;  // of its world
  };
  struct Mesh {
    softbody::MeshSource mesh;
    std::shared_ptr<const softbody::Prototype> prototype;  // of imported_material(); held so that a world finds it
  };
  struct World {
    std::filesystem::path path;
    softbody::Scene scene;
    std::unique_ptr<softbody::World> world;
  };
  using Question = std::variant<softbody::MeshFile, SceneToRead>;
  using Answer = std::variant<Mesh, World, std::string>;  // string: why there is nothing
  Answer answer(const Question& question, const std::stop_token& stop) const;
};

/// A soft body of this mesh that keeps its shape: free above the middle of the scene, clear of solids and bodies.
softbody::BodySource place_above(const softbody::World& world, softbody::MeshSource mesh);

/// What such a body is made of: springs, and shape matching in place of gas, which no concave or open mesh could hold.
/// It swings and bends as a body of 1 m and 1 kg does, but weighs more if it is larger.
softbody::Material imported_material(double extent);

class Import {
 public:
  /// On one file: what was found in it and done to it, a line each; or why it was refused.
  struct FileReport {
    std::vector<std::string> lines;
    bool refused = false;
  };
  static constexpr float min_size = 0.05f, max_size = 20;   // m
  static constexpr double min_weld = 1e-7, max_weld = 0.1;  // times a mesh's size

  std::string path;                         // OBJ or TOML
  float size = 1;                           // m, the largest extent that a mesh is scaled to
  double weld = softbody::MeshFile{}.weld;  // times the size: see there
  bool z_is_up = false;                     // in the file; else y is

  /// A scene of this path replaces the present one as soon as it is read, a mesh joins it.
  void load(Session& session);
  /// The same for files dropped on the window, one after another.
  void drop(const std::vector<std::string>& files, Session& session);
  /// Once a frame.
  void follow(Session& session);

  bool busy() const { return reading_; }
  /// What is being read, and for how long; empty unless busy().
  std::string progress() const;
  /// On the files since the last load(), in their order: every refusal, and the last few of the others.
  const std::vector<FileReport>& report() const { return report_; }
  /// It has been read.
  void dismiss_report() { report_.clear(); }

 private:
  static constexpr std::size_t max_file_reports = 5;

  void open(Session& session);
  void add(FileReport file_report);
  void refuse(Session& session, const std::string& why);
  void read(FileReader::Question question);
  void take(Session& session, FileReader::Answer answer);
  void enter(Session& session, FileReader::World answer);
  void join(Session& session, FileReader::Mesh read);

  std::vector<FileReport> report_;
  std::vector<std::string> dropped_;  // still to be loaded
  bool reading_ = false;
  std::chrono::steady_clock::time_point began_;
  BackgroundWorker<FileReader> reader_;
};

}  // namespace app
