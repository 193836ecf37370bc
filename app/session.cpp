#include "app/session.h"

#include <algorithm>
#include <cmath>

namespace app {
namespace {

constexpr std::uint64_t most_work = 1'000'000'000;  // pair tests of a frame in the window's thread: about half a second

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
      paper_(collide::find_method(collide::paper_method)->make()),
      exact_(collide::find_method(collide::default_method)->make()) {
  start(scene);
  scene_file_ = SceneFile(scene_name.empty() ? scene.key : std::move(scene_name), scene);
  adopt(std::move(scene));
}

void Session::adopt(softbody::Scene scene) {
  scene_ = std::move(scene);
  solids_ = list_solids(scene_);
}

void Session::start(const softbody::Scene& scene) {
  auto world = std::make_unique<softbody::World>(scene, softbody::World::Options{.threads = threads_});
  remember();
  world_ = std::move(world);
  begin();
}

/// The world that is about to be left.
void Session::remember() {
  if (!world_) return;
  world_->release();
  if (past_.size() == most_past) past_.erase(past_.begin());
  past_.push_back({std::move(world_), scene_, scene_file_, solids_});
}

/// Another world has come.
void Session::begin() {
  selected_bucket_.reset();
  selected_body_.reset();
  history_.clear();
  notice_.clear();
  stability_.restart();
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
}

void Session::advance(double elapsed) {
  history_.frame_ms.push(static_cast<float>(elapsed * 1e3));
  if (step_once_) {
    step_once_ = false;
    step();
  } else if (!paused) {
    run(elapsed);
  }
  follow();
}

void Session::advance_one(double elapsed, bool one) {
  history_.frame_ms.push(static_cast<float>(elapsed * 1e3));
  if (one && (!paused || step_once_)) {
    step_once_ = false;
    accumulator_ = 0;
    step();
  }
  follow();
}

/// What is known about the world comes after it.
void Session::follow() {
  exchange_comparison();
  if (overlays.true_surfaces)
    surfaces_.exchange(*world_, before_last_step_, revision_);
  else
    surfaces_.restart(revision_);
}

void Session::run(double elapsed) {
  const double frame = world_->frame_time();
  const double asked = std::clamp(elapsed, 0.0, longest_elapsed) * (slow_motion ? slow_factor : 1.0);
  accumulator_ += asked;
  int steps = 0;
  double spent_ms = 0;
  const double budget_ms = std::max(step_budget_ms, step_budget_part * 1e3 * elapsed);
  while (!paused && accumulator_ >= frame && steps < most_steps && spent_ms < budget_ms) {
    step();
    accumulator_ -= frame;
    spent_ms += world_->profile().total_ms;
    ++steps;
  }
  // What is still owed is dropped: paying it back would make the next call longer, and the one after that (a spiral).
  if (accumulator_ >= frame) accumulator_ = std::fmod(accumulator_, frame);
  follow_pace(asked, steps);
}

void Session::follow_pace(double asked, int steps) {
  asked_ += asked;
  done_ += steps * world_->frame_time();
  const double window = slow_motion ? 0.5 * slow_factor : 0.5;
  if (asked_ < std::max(window, 4 * world_->frame_time())) return;
  pace_ = std::min(1.0, done_ / asked_);
  asked_ = done_ = 0;
}

float Session::between() const {
  if (!slow_motion || paused || world_->all_at_rest()) return 1.0f;
  return static_cast<float>(std::clamp(accumulator_ / world_->frame_time(), 0.0, 1.0));
}

DrawnPositions Session::drawn_positions(bool whole_steps) const {
  const Positions& before = before_last_step_;
  return {world_->positions(), before.x, before.y, before.z, whole_steps ? 1.0f : between()};
}

void Session::single_step() {
  paused = true;
  step_once_ = true;
}

void Session::step() {
  before_last_step_.copy(world_->positions());
  const bool was_at_rest = world_->all_at_rest();
  const bool alarmed = stability_.alarm().has_value();
  stability_.before_step(*world_);
  const bool stepped = succeeds([&] { world_->step(); });
  if (world_->grabbed()) stability_.intervened();  // a hand brings energy
  stability_.after_step(*world_, guarded);
  if (stability_.alarm() && !alarmed) paused = true;
  if (!stepped || !was_at_rest || !world_->all_at_rest()) ++revision_;
  history_.detect_ms.push(static_cast<float>(world_->profile().detect_ms));
  history_.solve_ms.push(static_cast<float>(world_->profile().solve_ms));
  history_.contacts.push(static_cast<float>(world_->detection().contacts.size()));
}

bool Session::succeeds(const std::function<void()>& change) {
  try {
    change();
    return true;
  } catch (const std::exception& error) {
    notice_ = error.what();
    paused = true;
    return false;
  }
}

void Session::choose_scene(const std::string& key_or_path) {
  try {
    softbody::Scene scene = softbody::find_scene(key_or_path, scene_folder_);
    start(scene);
    scene_file_ = SceneFile(key_or_path, scene);
    adopt(std::move(scene));
  } catch (const std::exception& error) {
    notice_ = error.what();
  }
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

void Session::reset() {
  try {
    start(scene_in_use());
  } catch (const std::exception& error) {
    notice_ = error.what();  // the present world goes on
  }
}

void Session::rewind_to(int frame) {
  stability_.keep_present(*world_);
  const auto& past = stability_.past();
  if (past.snapshots().empty()) return;
  const std::string method(world_->method().key);
  const softbody::ContactSurface surface = world_->scene().contact_surface;
  const collide::Settings settings = world_->collision();
  const bool default_cell_size = world_->uses_default_cell_size();
  const std::string integrator(world_->integrator().key);
  const std::optional<int> substeps = world_->substeps();
  const softbody::Scene in_use = world_->scene();
  notice_.clear();
  succeeds([&] {
    world_->restore(past.snapshots()[past.at(frame)]);
    if (integrator != world_->integrator().key || substeps != world_->substeps())
      world_->set_integrator(integrator, substeps);
    if (surface != world_->scene().contact_surface) world_->set_contact_surface(surface);
    keep_world_settings(in_use);
    if (method != world_->method().key) world_->set_method(method);
    if (settings != world_->collision() || default_cell_size != world_->uses_default_cell_size())
      world_->set_collision(settings, default_cell_size);
  });
  paused = true;
  stability_.went_back();
  show_anew();
}

void Session::save_scene(const std::filesystem::path& file, const softbody::View& view) {
  softbody::Scene scene = scene_in_use();
  scene.view = view;
  notice_.clear();
  try {
    scene_file_ = SceneFile::save(std::move(scene), file);
  } catch (const std::exception& error) {
    notice_ = error.what();
  }
}

Work Session::work_of(const collide::Method& method, const collide::Settings& settings) const {
  Forecast forecast;
  forecast.begin(world_->positions(), settings, 0);
  return forecast.of(static_cast<std::size_t>(&method - collide::methods().data()));
}

/// False, with a notice(), if the method would hold the window up: it runs where the bodies are moved and drawn.
bool Session::affordable(const collide::Method& method, const collide::Settings& settings) {
  const Work work = work_of(method, settings);
  if (work.cost() <= most_work) return true;
  notice_ = std::string(method.name);
  notice_.append(" would take ").append(work.in_words()).append(" a frame here: too long to drive the bodies with");
  return false;
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
  try {
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
    scene_.bodies.push_back(std::move(body));
    stability_.intervened();
  } catch (const std::exception& error) {
    notice_ = error.what();
  }
  ++revision_;
}

const std::string& Session::caption() const {
  static const std::string none;
  if (world_->bodies().count() > world_->scene().bodies.size()) return none;  // dropped bodies tell another story
  const std::string* text = &none;
  for (const softbody::Caption& caption : world_->scene().captions) {
    if (caption.frame <= world_->frame()) text = &caption.text;
  }
  return *text;
}

void Session::set_method(std::string_view key) {
  const collide::Method* method = collide::find_method(key);
  if (!method || key == world_->method().key || !affordable(*method, world_->collision())) return;
  notice_.clear();
  succeeds([&] { world_->set_method(key); });
  ++revision_;
  select_bucket(selected_bucket_);
  history_.recall.clear();
}

void Session::next_method() {
  const auto all = collide::methods();
  const auto here = std::ranges::find(all, world_->method().key, &collide::Method::key);
  const auto first = static_cast<std::size_t>(here - all.begin());
  for (std::size_t i = 1; i < all.size(); ++i) {
    const collide::Method& next = all[(first + i) % all.size()];
    if (!affordable(next, world_->collision())) continue;
    set_method(next.key);
    return;
  }
}

void Session::set_contact_surface(softbody::ContactSurface surface) {
  if (surface == world_->scene().contact_surface) return;
  notice_.clear();
  succeeds([&] { world_->set_contact_surface(surface); });
  stability_.intervened();
  ++revision_;
}

void Session::set_integrator(std::string_view key, std::optional<int> substeps) {
  notice_.clear();
  succeeds([&] { world_->set_integrator(key, substeps); });
  stability_.intervened();
  ++revision_;
}

void Session::next_contact_surface() {
  const auto& all = softbody::contact_surfaces;
  const auto here =
      std::ranges::find(all, world_->scene().contact_surface, &softbody::ContactSurfaceInfo::value) - all.begin();
  set_contact_surface(all[(static_cast<std::size_t>(here) + 1) % all.size()].value);
}

void Session::set_collision(const collide::Settings& settings, bool default_cell_size) {
  // The automatic cell size is the world's own business, so a bad one of the caller's does no harm.
  collide::Settings checked = settings;
  if (default_cell_size) checked.cell_size = world_->collision().cell_size;
  if (notice_ = collide::problem(checked); !notice_.empty()) return;
  if (!affordable(world_->method(), checked)) return;
  succeeds([&] { world_->set_collision(checked, default_cell_size); });
  stability_.intervened();
  ++revision_;
  select_bucket(selected_bucket_);
  forget_measurements();
}

void Session::select_bucket(std::optional<std::uint32_t> bucket) {
  const bool exists = bucket && *bucket < world_->collision().buckets;
  selected_bucket_ = exists ? bucket : std::nullopt;
}

const collide::Method& Session::shown_method() const {
  return world_->method().uses_hash ? world_->method() : *collide::find_method(collide::paper_method);
}

const collide::DebugGeometry& Session::debug() const {
  if (debug_revision_ == revision_) return debug_;
  debug_revision_ = revision_;
  if (world_->method().uses_hash) return debug_ = world_->detector().debug();
  constexpr std::uint64_t most = most_work / 30;  // this is for each picture, and drives nothing
  const bool short_work = work_of(shown_method(), world_->collision()).cost() <= most;
  return debug_ = short_work ? picture_of(*paper_) : collide::DebugGeometry{};
}

/// Of a detector of our own. Empty if it runs out of memory, or finds more contacts than it may report.
collide::DebugGeometry Session::picture_of(collide::Detector& detector) const {
  try {
    collide::Workers alone(1);
    collide::Result unused;
    detector.forget();
    detector.detect(world_->positions(), world_->collision(), alone, unused);
    return detector.debug();
  } catch (const std::exception&) {
    return {};
  }
}

const std::vector<softbody::SurfaceTouch>& Session::touches() const {
  if (touches_revision_ == revision_) return touches_;
  touches_revision_ = revision_;
  return touches_ = world_->dynamics().surface_contact().touches(world_->bodies());
}

std::vector<collide::DebugGeometry::Box> Session::areas() const {
  const collide::Method& exact = *collide::find_method(collide::default_method);
  if (work_of(exact, world_->collision()).cost() > most_work) return {};
  return picture_of(*exact_).boxes;
}

const CompareRow* Session::driver_row() const {
  if (comparison_.rows.empty()) return nullptr;
  const CompareRow& row = comparison_.rows[driver()];
  return row.scored ? &row : nullptr;
}

const std::vector<collide::Contact>* Session::missed() const {
  if (comparison_.rows.empty()) return nullptr;
  const CompareRow& row = comparison_.rows[misses_of()];
  return row.scored ? &row.missed : nullptr;
}

void Session::exchange_comparison() {
  if (auto report = compare_worker_.take(); report && report->id >= first_comparable_) keep(std::move(*report));
  // A world at rest has nothing new for the recall, but times want to be taken again and again.
  if ((offered_ == revision_ && !compare.on) || !compare_worker_.ready()) return;
  offered_ = revision_;
  compare_worker_.offer(snapshot());
}

void Session::keep(CompareReport report) {
  comparison_ = std::move(report);
  ++comparisons_;
  if (const CompareRow* row = driver_row()) history_.recall.push(static_cast<float>(row->recall));
  for (std::size_t i = 0; i < comparison_.rows.size(); ++i) {
    Ring& times = history_.method_ms[i];
    if (const auto ms = comparison_.rows[i].ms)
      times.push(static_cast<float>(*ms));
    else
      times.clear();
  }
}

Snapshot Session::snapshot() const {
  Snapshot copy;
  copy.id = revision_;
  copy.world = worlds_;
  copy.at.copy(world_->positions());
  copy.bodies = world_->bodies();
  copy.settings = world_->collision();
  copy.driver = driver();
  copy.found = world_->detection();
  if (compare.on) copy.chosen = compare.methods;
  return copy;
}

/// What was measured with other settings: its report stays until there is a new one, its curves do not.
void Session::forget_measurements() {
  history_.recall.clear();
  for (Ring& times : history_.method_ms) times.clear();
  first_comparable_ = revision_;
}

}  // namespace app
