#include "app/session/import.h"

#include <strings.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iterator>

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

std::vector<std::string> lines_about(const FileReader::Mesh& read, const softbody::BodiesInMotion& world) {
  const softbody::MeshSource& mesh = read.mesh;
  const softbody::ImportFindings& f = mesh.imported->findings;
  std::vector<std::string> lines{
      fmt::format("{}: {} vertices, {} triangles", mesh.file.path.filename().string(),
                  grouped(mesh.imported->mesh.vertices.size()), grouped(mesh.imported->mesh.triangles.size())),
      fmt::format("scaled from {:.4g} to {:.4g} m", f.file_extent, f.extent)};
  const std::string changed = softbody::remarks(*mesh.imported);
  if (mesh.imported->simulated().vertices.size() > many_particles)
    lines.push_back("so many particles that the world may run slower than real time");
  if (world.scene().contact_surface == softbody::ContactSurface::vertices) {
    const double tolerance = static_cast<double>(world.collision().tolerance);
    if (read.model->mean_edge < finest_edge * tolerance)
      lines.push_back("much finer than the tolerance: vertex-vertex contact may let others sink in, F is for surfaces");
    if (read.model->covering > tolerance)
      lines.push_back("faces wider than the tolerance: vertices may slip in between vertices, F is for surfaces");
  }
  lines.push_back(changed.empty() ? "closed, in one piece, taken as it is" : changed);
  return lines;
}

/// Returns a mesh without its model, or what a window can show.
FileReader::Answer read_file(const FileReader::Question& question,
                             const std::function<void(std::string_view)>& begin_stage) {
  if (const auto* file = std::get_if<softbody::MeshFile>(&question.file))
    return FileReader::Mesh{softbody::MeshSource::from_file(*file, begin_stage), nullptr};
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

/// Returns true for the file that an export of motion writes beside its frames.
bool is_rest_shape(const std::filesystem::path& file) { return file.filename() == files::rest_shape_name; }

}  // namespace

std::optional<FileReader::Answer> FileReader::advance(const Question& question, Background<FileReader>& background) {
  struct Cancelled {};
  const auto begin_stage = [&](std::string_view name) {
    if (background.cancelled()) throw Cancelled{};
    background.publish(Stage{std::string(name)});
  };
  try {
    if (!read_) {
      read_ = read_file(question, begin_stage);
      return std::nullopt;
    }
    Answer answer = *std::exchange(read_, std::nullopt);
    if (auto* mesh = std::get_if<Mesh>(&answer)) {
      begin_stage("preparing the body");
      mesh->model = softbody::shared_body_model(mesh->mesh, imported_material(mesh->mesh.imported->findings.extent));
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
  if (!reading_) return {};
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
  if (reading_) reader_.cancel();
}

void Import::add(FileReport file_report) {
  report_.push_back(std::move(file_report));
  if (report_.size() <= max_file_reports) return;
  const auto newest = report_.end() - 1,
             oldest = std::ranges::find(report_.begin(), newest, false, &FileReport::refused);
  if (oldest != newest) report_.erase(oldest);
}

void Import::refuse(const std::string& why) {
  if (is_dropped_) return add({.lines = {why}, .refused = true});
  problem_.set(path, why);
}

void Import::load() {
  if (path.empty() || reading_) return;
  report_.clear();
  problem_.clear();
  is_dropped_ = false;
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
  reading_ = true;
  stage_.clear();
  reader_.offer({std::move(file), simulation_.threads()});
}

void Import::drop(const std::vector<std::string>& files) {
  std::vector<std::string> frames;
  if (!busy() && !frames_ && std::ranges::all_of(files, is_mesh))
    std::ranges::remove_copy_if(files, std::back_inserter(frames), is_rest_shape);
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
  dropped_.insert(dropped_.begin(), files.begin(), files.end());
  open_next();
}

bool Import::update() {
  bool has_joined = false;
  std::optional<FileReader::Answer> answer = reader_.take();
  if (auto* stage = answer ? std::get_if<FileReader::Stage>(&*answer) : nullptr) {
    stage_ = std::move(stage->name);
  } else if (answer) {
    reading_ = false;
    if (!reader_.cancelled()) has_joined = take(std::move(*answer));
  }
  open_next();
  return has_joined;
}

/// Begins to read the first of the files that wait, if nothing else is read or asked.
void Import::open_next() {
  if (reading_ || frames_ || dropped_.empty()) return;
  path = dropped_.front();
  dropped_.erase(dropped_.begin());
  is_dropped_ = true;
  problem_.clear();
  open();
}

/// Returns true if it is a mesh that has joined the scene.
bool Import::take(FileReader::Answer answer) {
  if (std::vector<std::string> files = std::exchange(together_, {}); !files.empty()) {
    if (auto* world = std::get_if<FileReader::World>(&answer)) {
      frames_.emplace(Frames{std::move(files), std::move(*world)});
      if (!simulation_.simulated()) play();  // no body could join
    } else {                                 // they are no frames
      dropped_.insert(dropped_.begin(), files.begin(), files.end());
    }
  } else if (const auto* why = std::get_if<std::string>(&answer)) {
    refuse(*why);
  } else if (auto* mesh = std::get_if<FileReader::Mesh>(&answer)) {
    return join(std::move(*mesh));
  } else {
    enter(std::move(std::get<FileReader::World>(answer)));
  }
  return false;
}

void Import::enter(FileReader::World answer) {
  try {
    scenes_.enter(std::move(answer.shown), std::move(answer.opened.scene), answer.path.string());
    add({.lines = {std::move(answer.what)}});
  } catch (const std::exception& error) {
    refuse(error.what());
  }
}

bool Import::join(FileReader::Mesh read) {
  const std::string name = read.mesh.file.path.filename().string();
  std::vector<std::string> lines = lines_about(read, simulation_.world());
  Material material = imported_material(read.mesh.imported->findings.extent);
  softbody::BodySource body = place_above(simulation_.world(), std::move(read.mesh));
  const JoinedAt place{body.position, softbody::bounding_radius(body.mesh.imported->mesh)};
  bodies_.add(std::move(body), std::move(material));
  Notice& notice = simulation_.notice;
  if (notice.is_error()) {
    refuse(name + ": " + notice.text());
    notice.clear();  // once is enough
    return false;
  }
  joined_ = place;
  add({.lines = std::move(lines)});
  return true;
}

}  // namespace app::session
