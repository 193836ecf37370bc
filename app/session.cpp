#include "app/session.h"

#include <algorithm>
#include <cmath>

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

void Positions::copy(const collide::Frame& frame) {
  x.assign(frame.x.begin(), frame.x.end());
  y.assign(frame.y.begin(), frame.y.end());
  z.assign(frame.z.begin(), frame.z.end());
}

Session::Session(softbody::Scene scene, std::filesystem::path scene_folder, int threads)
    : scene_folder_(std::move(scene_folder)), scenes_(list_scenes(scene_folder_)), threads_(threads) {
  start(scene);
  scene_ = std::move(scene);
}

void Session::start(const softbody::Scene& scene) {
  world_ = std::make_unique<softbody::World>(scene, softbody::World::Options{.threads = threads_});
  before_last_step_.copy(world_->positions());
  accumulator_ = 0;
  step_once_ = false;
  selected_bucket_.reset();
  history_.clear();
  notice_.clear();
  ++revision_;
  forget_recall();
}

void Session::advance(double elapsed) {
  history_.frame_ms.push(static_cast<float>(elapsed * 1e3));
  if (step_once_) {
    step_once_ = false;
    step();
  } else if (!paused) {
    run(elapsed);
  }
  exchange_recall();
}

void Session::run(double elapsed) {
  const double frame = world_->frame_time();
  const double asked = std::clamp(elapsed, 0.0, longest_elapsed) * (slow_motion ? slow_factor : 1.0);
  accumulator_ += asked;
  int steps = 0;
  double spent_ms = 0;
  const double budget_ms = std::max(step_budget_ms, step_budget_part * 1e3 * elapsed);
  while (accumulator_ >= frame && steps < most_steps && spent_ms < budget_ms) {
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

void Session::single_step() {
  paused = true;
  step_once_ = true;
}

void Session::step() {
  before_last_step_.copy(world_->positions());
  const bool was_at_rest = world_->all_at_rest();
  const bool stepped = succeeds([&] { world_->step(); });
  if (!stepped || !was_at_rest || !world_->all_at_rest()) ++revision_;
  history_.detect_ms.push(static_cast<float>(world_->profile().detect_ms));
  history_.solve_ms.push(static_cast<float>(world_->profile().solve_ms));
  history_.contacts.push(static_cast<float>(world_->detection().contacts.size()));
}

/// False if a detector refused (too many contacts for the memory, say): then the world waits, and notice() says why.
template <class Change>
bool Session::succeeds(Change&& change) {
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
    scene_ = std::move(scene);
  } catch (const std::exception& error) {
    notice_ = error.what();
  }
}

void Session::reset() {
  softbody::Scene scene = scene_;
  scene.method = world_->method().key;
  scene.collision = world_->collision();
  scene.default_cell_size = world_->uses_default_cell_size();
  start(scene);
}

void Session::restore_settings() {
  set_method(scene_.method);
  set_collision(scene_.collision, scene_.default_cell_size);
}

void Session::drop() {
  if (!can_drop()) return;
  succeeds([&] { world_->drop(); });
  ++revision_;
}

const std::string& Session::caption() const {
  static const std::string none;
  const std::string* text = &none;
  for (const softbody::Caption& caption : world_->scene().captions) {
    if (caption.frame <= world_->frame()) text = &caption.text;
  }
  return *text;
}

void Session::set_method(std::string_view key) {
  if (!collide::find_method(key) || key == world_->method().key) return;
  notice_.clear();
  succeeds([&] { world_->set_method(key); });
  ++revision_;
  select_bucket(selected_bucket_);
  forget_recall();
}

void Session::next_method() {
  const auto all = collide::methods();
  const auto here = std::ranges::find(all, world_->method().key, &collide::Method::key);
  set_method(all[static_cast<std::size_t>(here - all.begin() + 1) % all.size()].key);
}

void Session::set_collision(const collide::Settings& settings, bool default_cell_size) {
  // The automatic cell size is the world's own business, so a bad one of the caller's does no harm.
  collide::Settings checked = settings;
  if (default_cell_size) checked.cell_size = world_->collision().cell_size;
  if (notice_ = collide::problem(checked); !notice_.empty()) return;
  succeeds([&] { world_->set_collision(checked, default_cell_size); });
  ++revision_;
  select_bucket(selected_bucket_);
}

void Session::select_bucket(std::optional<std::uint32_t> bucket) {
  const bool exists = bucket && world_->method().uses_hash && *bucket < world_->collision().buckets;
  selected_bucket_ = exists ? bucket : std::nullopt;
}

const collide::DebugGeometry& Session::debug() const {
  if (debug_revision_ != revision_) {
    debug_ = world_->detector().debug();
    debug_revision_ = revision_;
  }
  return debug_;
}

void Session::exchange_recall() {
  if (auto report = recall_worker_.take(); report && report->id >= first_comparable_) {
    recall_ = std::move(*report);
    if (!recall_.rows.empty()) history_.recall.push(static_cast<float>(recall_.rows.front().recall));
  }
  if (offered_ == revision_ || !recall_worker_.ready()) return;
  offered_ = revision_;
  if (std::string why = refusal(world_->bodies(), world_->collision().self_collision); !why.empty()) {
    recall_ = {};
    recall_.id = revision_;
    recall_.skipped = std::move(why);
    return;
  }
  Positions now;
  now.copy(world_->positions());
  Snapshot snapshot{.id = revision_,
                    .x = std::move(now.x),
                    .y = std::move(now.y),
                    .z = std::move(now.z),
                    .bodies = world_->bodies(),
                    .settings = world_->collision(),
                    .found = {}};
  snapshot.found.push_back({world_->method().key, world_->detection().contacts});
  recall_worker_.offer(std::move(snapshot));
}

void Session::forget_recall() {
  recall_ = {};
  first_comparable_ = revision_;
}

}  // namespace app
