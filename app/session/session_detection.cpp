// Session: methods, settings and what is found with them.

#include "app/session/session.h"

#include <algorithm>
#include <cmath>

namespace app {

WorkEstimate Session::work_of(const collide::Method& method, const collide::Settings& settings) const {
  CostModel cost_model;
  cost_model.begin(world_->positions(), settings, 0);
  return cost_model.of(static_cast<std::size_t>(&method - collide::method_table().data()));
}

/// False, with a notice(), if the method would hold the window up: it runs where the bodies are moved and drawn.
bool Session::affordable(const collide::Method& method, const collide::Settings& settings) {
  const WorkEstimate work = work_of(method, settings);
  if (work.cost() <= most_work) return true;
  notice_ = std::string(method.name);
  notice_.append(" would take ").append(work.in_words()).append(" a frame here: too long to drive the bodies with");
  return false;
}

void Session::set_method(std::string_view key) {
  const collide::Method* method = collide::find_method(key);
  if (!method || key == world_->method().key || !affordable(*method, world_->collision())) return;
  notice_.clear();
  succeeds([&] { world_->set_method(key); });
  restart_ghost();
  ++revision_;
  select_bucket(selected_bucket_);
  history_.recall.clear();
}

void Session::next_method() {
  const auto all = collide::method_table();
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
  intervened();
  ++revision_;
}

void Session::set_integrator(std::string_view key, std::optional<int> substeps) {
  notice_.clear();
  succeeds([&] { world_->set_integrator(key, substeps); });
  intervened();
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
  intervened();
  ++revision_;
  select_bucket(selected_bucket_);
  forget_measurements();
}

const std::vector<softbody::SurfaceTouch>& Session::touches() const {
  if (touches_revision_ == revision_) return touches_;
  touches_revision_ = revision_;
  return touches_ = world_->dynamics().surface_contact().touches(world_->bodies());
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
  if ((offered_ == revision_ && !compare.on) || !compare_worker_.ready(rests())) return;
  offered_ = revision_;
  compare_worker_.offer(snapshot());
}

void Session::keep(CompareReport report) {
  comparison_ = std::move(report);
  ++comparisons_;
  if (const CompareRow* row = driver_row()) history_.recall.push(comparison_.frame, static_cast<float>(row->recall));
  for (std::size_t i = 0; i < comparison_.rows.size(); ++i) {
    TimeSeries& times = history_.method_ms[i];
    if (const auto ms = comparison_.rows[i].ms)
      times.push(comparison_.frame, static_cast<float>(*ms));
    else
      times.clear();
  }
}

FrameSnapshot Session::snapshot() const {
  FrameSnapshot copy;
  copy.id = revision_;
  copy.frame_number = world_->frame();
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
  for (TimeSeries& times : history_.method_ms) times.clear();
  first_comparable_ = revision_;
}

}  // namespace app
