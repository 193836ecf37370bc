#include "app/session/session.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/files/inputs.h"

namespace app {
namespace {

std::vector<SceneChoice> list_scenes(const std::filesystem::path& folder) {
  std::vector<SceneChoice> list;
  for (const std::string& key : softbody::scene_keys(folder)) {
    try {
      const softbody::Scene scene = softbody::find_scene(key, folder);
      list.push_back({key, scene.name, scene.look_at});
    } catch (const softbody::SceneError& error) {
      list.push_back({key, key, error.what()});  // still listed: choosing it says what is wrong
    }
  }
  return list;
}

}  // namespace

Session::Session(softbody::Scene scene, std::filesystem::path scene_folder, int threads, std::string scene_name)
    : scene_folder_(std::move(scene_folder)),
      scenes_(list_scenes(scene_folder_)),
      threads_(threads),
      exact_(collide::find_method(collide::default_method)->make()) {
  protect_inputs(scene);
  start(scene, {});
  scene_file_ = SceneFile(scene_name.empty() ? scene.key : std::move(scene_name), scene);
  adopt(std::move(scene));
}

void Session::adopt(softbody::Scene scene) {
  scene_ = std::move(scene);
  solids_ = list_solids(scene_);
}

void Session::start(const softbody::Scene& scene, const IntegratorChoice& integrator) {
  leave_for(std::make_unique<softbody::World>(scene, softbody::World::Options{.threads = threads_,
                                                                              .integrator = integrator.key,
                                                                              .substeps = integrator.substeps,
                                                                              .max_work = softbody::work_of_a_window}));
}

void Session::leave_for(std::unique_ptr<softbody::World> world) {
  if (world_) {
    world_->release();
    remember({std::move(world_), {}, scene_, scene_file_, solids_});
  }
  world_ = std::move(world);
  begin();
}

void Session::remember(Past past) {
  if (past_.size() == most_past) past_.erase(past_.begin());
  past_.push_back(std::move(past));
}

/// Another world has come.
void Session::begin() {
  selected_bucket_.reset();
  selected_body_.reset();
  as_scripted_ = true;
  history_.clear();
  notice_.clear();
  stability_.restart(*world_);
  show_anew();
}

/// After the world has become another: what was found out about the one before is of no use.
void Session::show_anew() {
  select_body(selected_body_);
  before_last_step_.copy(world_->positions());
  accumulator_ = 0;
  step_once_ = false;
  ++revision_;
  ++worlds_;
  comparison_ = {};
  forget_measurements();
  surfaces_.restart(revision_);
  restart_ghost();
}

bool Session::succeeds(const std::function<void()>& change) {
  try {
    change();
    return true;
  } catch (const softbody::SceneError& error) {
    notice_ = error.what();
    return false;
  } catch (const std::length_error& beyond_a_limit) {
    notice_ = beyond_a_limit.what();
  } catch (const std::exception& error) {
    notice_ = std::string(defect) + error.what();
  }
  paused = true;
  return false;
}

void Session::choose_scene(const std::string& key_or_path) {
  try {
    softbody::Scene scene = softbody::find_scene(key_or_path, scene_folder_);
    auto world = std::make_unique<softbody::World>(
        scene, softbody::World::Options{.threads = threads_, .max_work = softbody::work_of_a_window});
    enter(std::move(world), std::move(scene), key_or_path);
  } catch (const std::exception& error) {
    notice_ = error.what();
  }
}

void Session::enter(std::unique_ptr<softbody::World> world, softbody::Scene scene, const std::string& key_or_path) {
  protect_inputs(scene);
  SceneFile file(key_or_path, scene);
  leave_for(std::move(world));
  scene_file_ = std::move(file);
  adopt(std::move(scene));
}

softbody::Scene Session::scene_in_use() const {
  softbody::Scene scene = scene_;
  const softbody::Scene& now = world_->scene();
  scene.gravity = now.gravity;
  std::ranges::copy(now.materials, scene.materials.begin());
  put_solids(solids_, scene);
  scene.method = world_->method().key;
  scene.contact_surface = now.contact_surface;
  scene.collision = world_->collision();
  scene.default_cell_size = world_->uses_default_cell_size();
  return scene;
}

softbody::Scene Session::scene_as_it_is() const {
  softbody::Scene scene = scene_in_use();
  scene.bodies = world_->sources();
  return scene;
}

void Session::reset() {
  try {
    start(scene_in_use(), integrator());
  } catch (const std::exception& error) {
    notice_ = error.what();  // the present world goes on
  }
}

/// The bodies as they were, with the settings in use.
void Session::restore(const softbody::Snapshot& snapshot) {
  const std::string method(world_->method().key);
  const softbody::ContactSurface surface = world_->scene().contact_surface;
  const collide::Settings settings = world_->collision();
  const bool default_cell_size = world_->uses_default_cell_size();
  const std::string integrator(world_->integrator().key);
  const std::optional<int> substeps = world_->substeps();
  const softbody::Scene in_use = world_->scene();
  notice_.clear();
  succeeds([&] {
    world_->restore(snapshot);
    if (integrator != world_->integrator().key || substeps != world_->substeps())
      world_->set_integrator(integrator, substeps);
    if (surface != world_->scene().contact_surface) world_->set_contact_surface(surface);
    keep_world_settings(in_use);
    if (method != world_->method().key) world_->set_method(method);
    if (settings != world_->collision() || default_cell_size != world_->uses_default_cell_size())
      world_->set_collision(settings, default_cell_size);
  });
}

void Session::rewind_to(int frame) {
  stability_.keep_present(*world_);
  const auto& past = stability_.past();
  if (past.snapshots().empty()) return;
  restore(past.snapshots()[past.at(frame)]);
  paused = true;
  went_back();
}

void Session::went_back() {
  stability_.went_back(*world_);
  for (TimeSeries* series : {&history_.detect_ms, &history_.solve_ms, &history_.contacts, &history_.recall})
    series->forget_from(world_->frame());
  show_anew();
}

void Session::save_scene(const std::filesystem::path& file, const softbody::View& view) {
  softbody::Scene scene = scene_as_it_is();
  scene.view = view;
  notice_.clear();
  try {
    scene_file_ = SceneFile::save(std::move(scene), file);
  } catch (const std::exception& error) {
    notice_ = error.what();
  }
}

void Session::restore_settings() {
  set_contact_surface(scene_.contact_surface);
  set_method(scene_.method);
  set_collision(scene_.collision, scene_.default_cell_size);
  set_method(scene_.method);  // again: it may have been too slow with the settings before
}

namespace {

/// The index of such a material in a list, whatever it is called there; the list's length if there is none.
std::size_t find_material(const std::vector<softbody::Material>& all, softbody::Material material) {
  return static_cast<std::size_t>(std::ranges::find_if(all,
                                                       [&](const softbody::Material& other) {
                                                         material.name = other.name;
                                                         return material == other;
                                                       }) -
                                  all.begin());
}

void make_name_new(std::string& name, const std::vector<softbody::Material>& all) {
  const std::string stem = name;
  for (int number = 2; std::ranges::count(all, name, &softbody::Material::name) > 0; ++number)
    name = stem + " " + std::to_string(number);
}

}  // namespace

void Session::add_body(softbody::BodySource body, softbody::Material material) {
  notice_.clear();
  as_scripted_ = false;
  try {
    protect_input(body.mesh);
    Past present = as_it_is();
    const std::size_t known = find_material(scene_.materials, material);
    body.material = static_cast<int>(known);
    if (known == scene_.materials.size()) {
      make_name_new(material.name, scene_.materials);
      scene_.materials.push_back(std::move(material));
    }
    // Also those that came after the past that the world has gone back to.
    for (std::size_t i = world_->scene().materials.size(); i < scene_.materials.size(); ++i)
      world_->add_material(scene_.materials[i]);
    world_->add(body);
    remember(std::move(present));
    intervened();
  } catch (const std::exception& error) {
    notice_ = error.what();
  }
  ++revision_;
}

const std::string& Session::caption() const {
  static const std::string none;
  if (!as_scripted_) return none;  // what hands do is another story
  const std::string* text = &none;
  for (const softbody::Caption& caption : world_->scene().captions) {
    if (caption.frame <= world_->frame()) text = &caption.text;
  }
  return *text;
}

}  // namespace app
