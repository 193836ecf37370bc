#include "app/session/import.h"

#include <strings.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iterator>
#include <limits>

#include <fmt/core.h>
#include <glm/vec3.hpp>

#include "app/base/text.h"
#include "app/files/obj_writer.h"
#include "app/files/playback.h"
#include "softbody/contact/keys.h"
#include "softbody/forces/springs.h"
#include "softbody/mesh/file_mesh.h"
#include "softbody/model/body_model.h"
#include "softbody/world/body_model_set.h"
#include "softbody/world/measures.h"

namespace app::session {

using softbody::Material;

namespace {

constexpr std::size_t many_particles = 3000;
constexpr double finest_edge = 0.2;  // in tolerances
constexpr const char* opening = "opening of a mesh";

/// Returns the lowest height from `at` upwards at which a ball of this radius is clear of bodies and solids.
double clear_height(const softbody::BodiesInMotion& world, glm::dvec3 at, double radius) {
  const double gap = radius + static_cast<double>(world.collision().tolerance);
  const collide::Frame p = world.positions();
  for (std::size_t i = 0; i < p.x.size(); ++i)
    if (std::hypot(double{p.x[i]} - at.x, double{p.z[i]} - at.z) < gap) at.y = std::max(at.y, double{p.y[i]} + gap);
  constexpr int max_tries = 1000;  // a scene may be solid all the way up
  for (int i = 0; i < max_tries && softbody::solid_depth(world.scene(), at).depth > -gap; ++i) at.y += 0.1 * gap;
  return at.y;
}

/// Returns what was found in a mesh, what was changed, and what may surprise in this scene.
std::string text_about(const softbody::MeshSource& mesh, const softbody::BodyModel& model,
                       const softbody::Scene& scene) {
  const std::string changed = softbody::remarks(*mesh.imported);
  std::string text = fmt::format("{}: {} vertices, scaled to {:.4g} m, {}", mesh.file.path.filename().string(),
                                 grouped(mesh.imported->mesh.vertices.size()), mesh.imported->findings.extent,
                                 changed.empty() ? "closed, in one piece, taken as it is" : changed);
  if (mesh.imported->simulated().vertices.size() > many_particles)
    text += "; so many particles that the world may run slower than real time";
  if (scene.contact_surface != softbody::ContactSurface::vertices) return text;
  const double tolerance = static_cast<double>(scene.collision.tolerance);
  if (model.mean_edge < finest_edge * tolerance)
    text += "; much finer than the tolerance: vertex-vertex contact may let others sink in, F is for surfaces";
  if (model.covering > tolerance)
    text += "; faces wider than the tolerance: vertices may slip in between vertices, F is for surfaces";
  return text;
}

/// Returns what a window can show.
FileReader::Answer read_file(const FileReader::Question& question) {
  if (const auto* frames = std::get_if<FileReader::FramesToRead>(&question.file)) {
    files::Opened opened = files::open_recording(*frames);
    for (const int number : {1, opened.recording->frame_count() - 1}) opened.recording->frame(number);
    std::string look_at = opened.scene.look_at;
    return FileReader::World{frames->front(), std::move(look_at), std::move(opened), {}};
  }
  const auto& [path, presets] = std::get<FileReader::SceneToRead>(question.file);
  return FileReader::World{path, "scene " + path.filename().string(), softbody::load_scene(path, presets), {}};
}

bool is_mesh(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  return strcasecmp(ending.c_str(), ".obj") == 0 || strcasecmp(ending.c_str(), ".ply") == 0;
}

bool may_be_surroundings(const std::filesystem::path& file) { return file.filename() == files::surroundings_name; }

/// Returns true for the files that an export of motion writes beside its frames.
bool is_beside_frames(const std::filesystem::path& file) {
  return file.filename() == files::rest_shape_name || may_be_surroundings(file);
}

}  // namespace

std::optional<FileReader::Answer> FileReader::advance(const Question& question, Background<FileReader>& background) {
  struct Cancelled {};
  const auto begin_stage = [&](std::string_view name) {
    if (background.cancelled()) throw Cancelled{};
    background.publish(Stage{std::string(name)});
  };
  try {
    if (const auto* file = std::get_if<softbody::MeshFile>(&question.file); file && !read_) {
      if (!fine_) {
        softbody::MeshFile as_it_is = *file;
        as_it_is.resolution = std::numeric_limits<std::size_t>::max();
        fine_ = softbody::import_mesh(as_it_is, begin_stage);
        return std::nullopt;
      }
      softbody::ImportedMesh imported = *std::exchange(fine_, std::nullopt);
      softbody::add_coarse_mesh(imported, file->resolution);
      softbody::MeshSource mesh{.kind = "file", .file = *file};
      mesh.imported = std::make_shared<const softbody::ImportedMesh>(std::move(imported));
      read_ = Mesh{std::move(mesh), nullptr};
      return std::nullopt;
    }
    if (!read_) {
      read_ = read_file(question);
      return std::nullopt;
    }
    Answer answer = *std::exchange(read_, std::nullopt);
    if (auto* mesh = std::get_if<Mesh>(&answer)) {
      if (!mesh->model) {
        begin_stage("preparing the body");
        mesh->model = softbody::shared_body_model(mesh->mesh, imported_material(mesh->mesh.imported->findings.extent));
        if (!question.lone) return answer;
        read_ = std::move(answer);
        return std::nullopt;
      }
      if (background.cancelled()) return answer;
      softbody::Scene scene = lone_scene(mesh->mesh);
      question.lone(scene);
      auto shown = make_window_world(scene, question.integrator, question.threads);
      std::string text = text_about(mesh->mesh, *mesh->model, scene);
      return World{"", std::move(text), std::move(scene), std::move(shown), std::move(*mesh)};
    } else if (auto& world = std::get<World>(answer); !background.cancelled()) {
      world.shown = show_in_window(world.opened, question.threads);
    }
    return answer;
  } catch (const Cancelled&) {
    return std::string();
  } catch (const std::exception& error) {
    return failure_text(error);
  }
}

softbody::BodySource place_above(const softbody::BodiesInMotion& world, softbody::MeshSource mesh) {
  assert(mesh.imported);
  const softbody::Scene& scene = world.scene();
  softbody::BodySource body;
  const double radius = softbody::bounding_radius(mesh.imported->mesh);
  body.mesh = std::move(mesh);
  const glm::dvec3 at = scene.dropper ? scene.dropper->body.position : scene.view.target + glm::dvec3(0, 1, 0);
  body.position = {at.x, clear_height(world, at, radius), at.z};
  return body;
}

softbody::Scene lone_scene(softbody::MeshSource mesh) {
  assert(mesh.imported);
  const double extent = mesh.imported->findings.extent;
  double lowest = 0;  // m, below the mesh's origin
  for (const glm::dvec3& vertex : mesh.imported->mesh.vertices) lowest = std::min(lowest, vertex.y);
  softbody::Scene scene;
  scene.key = mesh.file.path.string();
  scene.name = mesh.file.path.filename().string();
  scene.look_at = "Your mesh falls on the ground. D drops another one, and B throws one.";
  // With a tolerance as wide as some faces, the detector would find most vertices of a fine mesh near each other. So
  // surfaces meet, unless there are so many that this takes too long.
  scene.collision.tolerance = static_cast<float>(0.02 * extent);
  if (mesh.imported->simulated().vertices.size() <= softbody::max_simulated_vertices)
    scene.contact_surface = softbody::ContactSurface::surfaces;
  scene.materials = {imported_material(extent)};
  scene.solids = {{softbody::Ground{}}};
  scene.view = {.target = {0, 0.6 * extent, 0}, .distance = 2.4 * extent};
  softbody::BodySource body;
  body.mesh = std::move(mesh);
  body.position = {0, 0.5 * extent - lowest, 0};
  scene.bodies = {body};
  body.position.y += 1.5 * extent;
  scene.dropper = softbody::Dropper{.body = std::move(body), .spread = 0.1 * extent};
  return scene;
}

Material imported_material(double extent) {
  assert(extent > 0);
  Material m;
  m.name = "imported";
  m[Material::mass] = std::clamp(extent * extent * extent, 0.01, 1000.0);
  m.set(softbody::StructuralSprings::keys, {200 * m[Material::mass], 0.1});
  m.set(softbody::BendSprings::keys, {50 * m[Material::mass], 0.1});
  m[softbody::contact::stiffness] = 100 * m[Material::mass];
  m[Material::internal_damping] = 10;
  m[softbody::contact::rebound_speed] = 2;
  m[softbody::contact::rolling_resistance] = 0.3;
  return m;
}

std::string Import::progress() const {
  if (!reader_.has_work()) return {};
  const auto seconds =
      std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - began_).count();
  std::string text = reader_.cancelled() ? "giving up " : "reading ";
  text += std::filesystem::path(path).filename().string();
  if (!stage_.empty()) text.append(": ").append(stage_);
  return text + (seconds > 0 ? ", " + std::to_string(seconds) + " s so far" : "");
}

void Import::cancel() {
  dropped_.clear();
  together_.clear();
  reader_.cancel();
}

void Import::age(double elapsed) {
  report_age_ += std::min(elapsed, 0.5);  // a picture may have taken long
  if (report_age_ < max_report_age || busy()) return;
  std::erase_if(report_, [](const FileReport& each) { return !each.refused; });
  lone_.clear();
}

void Import::add(FileReport file_report) {
  report_age_ = 0;
  report_.push_back(std::move(file_report));
  if (report_.size() <= max_file_reports) return;
  const auto newest = report_.end() - 1,
             oldest = std::ranges::find(report_.begin(), newest, false, &FileReport::refused);
  if (oldest != newest) report_.erase(oldest);
}

void Import::refuse(const std::string& why) {
  if (is_dropped_) return add({.text = why, .refused = true});
  problem_.set(path, why);
}

void Import::load() {
  if (path.empty() || reader_.has_work()) return;
  report_.clear();
  problem_.clear();
  is_dropped_ = joins_ = false;
  open();
}

void Import::open() {
  const std::filesystem::path file(path);
  if (file.extension() == ".toml") return read(FileReader::SceneToRead{file, scenes_.presets_file()});
  if (!is_mesh(file)) return refuse(path + ": neither a mesh (.obj, .ply) nor a scene (.toml)");
  softbody::MeshFile mesh{.path = std::filesystem::absolute(file), .size = double{size}, .weld = weld};
  if (z_is_up) mesh.up = {0, 0, 1};
  mesh.resolution = resolution;
  read(std::move(mesh));
}

void Import::read(decltype(FileReader::Question::file) file) {
  began_ = std::chrono::steady_clock::now();
  stage_.clear();
  const softbody::World* now = simulation_.simulated();
  reader_.offer({std::move(file), simulation_.threads, joins_ ? nullptr : lone_options,
                 now ? now->integrator_choice() : softbody::IntegratorChoice{}});
}

void Import::drop(const std::vector<std::string>& files, bool into_scene) {
  std::vector<std::string> frames;
  const auto may_belong = [](const std::string& file) { return is_mesh(file) || may_be_surroundings(file); };
  if (!busy() && !frames_ && std::ranges::all_of(files, may_belong))
    std::ranges::remove_copy_if(files, std::back_inserter(frames), is_beside_frames);
  if (!files.empty() && !busy()) joins_ = into_scene;
  if (frames.size() > 1) {
    together_ = files;
    // A file manager gives them in any order. Numbers count as numbers: 9 comes before 10.
    std::ranges::sort(frames, [](const auto& a, const auto& b) { return strverscmp(a.c_str(), b.c_str()) < 0; });
    path = frames.front();
    is_dropped_ = true;
    read(FileReader::FramesToRead(frames.begin(), frames.end()));
  } else {
    dropped_.insert(dropped_.end(), files.begin(), files.end());
  }
  open_next();
}

std::string Import::question() const {
  if (!frames_) return {};
  return fmt::format(
      "{} files; those read so far, the first two and the last, fit together as frames. Play them as a recording, or "
      "import each as a body?",
      grouped(static_cast<std::size_t>(frames_->world.opened.recording->frame_count())));
}

void Import::play() {
  assert(frames_);
  enter(std::move(std::exchange(frames_, std::nullopt)->world));
}

void Import::import_each() {
  assert(frames_);
  const std::vector<std::string> files = std::exchange(frames_, std::nullopt)->files;
  joins_ = false;
  dropped_.insert(dropped_.begin(), files.begin(), files.end());
  open_next();
}

void Import::update() {
  std::optional<FileReader::Answer> answer = reader_.take();
  if (auto* stage = answer ? std::get_if<FileReader::Stage>(&*answer) : nullptr) {
    stage_ = std::move(stage->name);
  } else if (answer && !reader_.cancelled()) {
    take(std::move(*answer));
  }
  open_next();
}

/// Begins to read the first of the files that wait, if nothing else is read or asked.
void Import::open_next() {
  if (reader_.has_work() || frames_ || dropped_.empty()) return;
  path = dropped_.front();
  dropped_.erase(dropped_.begin());
  is_dropped_ = true;
  problem_.clear();
  open();
}

void Import::take(FileReader::Answer answer) {
  if (std::vector<std::string> files = std::exchange(together_, {}); !files.empty()) {
    if (auto* world = std::get_if<FileReader::World>(&answer)) {
      std::erase_if(files, may_be_surroundings);
      frames_.emplace(Frames{std::move(files), std::move(*world)});
      if (!simulation_.simulated()) play();  // no body could join
    } else {                                 // they are no frames
      dropped_.insert(dropped_.begin(), files.begin(), files.end());
    }
  } else if (const auto* why = std::get_if<std::string>(&answer)) {
    refuse(*why);
  } else if (auto* mesh = std::get_if<FileReader::Mesh>(&answer)) {
    if (!lone_.empty()) lone_.push_back(*mesh);
    join(std::move(*mesh));
  } else {
    enter(std::move(std::get<FileReader::World>(answer)));
  }
}

void Import::enter(FileReader::World answer) {
  const bool may_join = simulation_.simulated();
  try {
    scenes_.enter(std::move(answer.shown), std::move(answer.opened.scene), answer.path.string(),
                  answer.lone ? opening : "choice of scene");
    add({.text = std::move(answer.what)});
    joins_ = simulation_.simulated();  // what was dropped with it
    lone_.clear();
    if (answer.lone && may_join) lone_.push_back(std::move(*answer.lone));
  } catch (const std::exception& error) {
    refuse(error.what());
  }
}

bool Import::can_join() const {
  return !lone_.empty() && simulation_.world().scene().key == lone_.front().mesh.file.path.string() &&
         can_undo(simulation_);
}

void Import::join_scene_before() {
  assert(can_join());
  // What was changed in the lone scene goes first.
  for (bool leaves = false; !leaves && can_undo(simulation_); undo(simulation_))
    leaves = simulation_.undo_history().next(Way::back).change == opening;
  std::vector<FileReader::Mesh> meshes = std::exchange(lone_, {});
  dismiss_report();
  for (FileReader::Mesh& mesh : meshes) join(std::move(mesh));
}

void Import::join(FileReader::Mesh read) {
  const std::string name = read.mesh.file.path.filename().string();
  std::string text = text_about(read.mesh, *read.model, simulation_.world().scene());
  Material material = imported_material(read.mesh.imported->findings.extent);
  softbody::BodySource body = place_above(simulation_.world(), std::move(read.mesh));
  const JoinedAt place{body.position, softbody::bounding_radius(body.mesh.imported->mesh)};
  const collide::Index bodies = simulation_.world().bodies().count();
  bodies_.add(std::move(body), std::move(material));
  Notice& notice = simulation_.notice;
  if (simulation_.world().bodies().count() == bodies) {  // else an error is of the second half
    refuse(name + ": " + notice.text());
    return notice.clear();  // once is enough
  }
  joined_ = place;
  add({.text = std::move(text)});
}

}  // namespace app::session
