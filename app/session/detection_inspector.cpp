#include "app/session/detection_inspector.h"

#include <cassert>

#include "app/session/window_work.h"
#include "collide/methods.h"

namespace app::session {

DetectionInspector::DetectionInspector(const Simulation& simulation, Half half)
    : simulation_(simulation), half_(half), exact_(collide::find_method(collide::default_method)->make()) {}

const collide::Method& DetectionInspector::shown_method() const {
  return world().method().uses_hash ? world().method() : *collide::find_method(collide::paper_method);
}

const collide::DebugGeometry& DetectionInspector::shown_geometry() const {
  if (!world().method().uses_hash) {
    shown_ = {};  // a table may be large
    return paper_geometry();
  }
  if (shown_.revision != simulation_.revision()) shown_ = {simulation_.revision(), world().detector().debug()};
  return shown_.value;
}

const collide::DebugGeometry& DetectionInspector::paper_geometry() const {
  if (world().method().key == collide::paper_method) return shown_geometry();
  constexpr collide::Index max_moving = 100'000;  // vertices: some 10 ms per picture
  const bool affordable = !moves(simulation_) || world().bodies().vertex_count() <= max_moving;
  const bool was_refused = affordable && paper_.value.buckets == 0;
  if (paper_.revision == simulation_.revision() && !was_refused) return paper_.value;
  paper_ = {simulation_.revision(), {}};
  if (!affordable) return paper_.value;
  collide::Workers alone(1);
  paper_.value = paper_structure_(world().positions(), world().collision(), alone);
  table_.revision = 0;
  return paper_.value;
}

const compare::TableContents& DetectionInspector::table() const {
  if (table_.revision != simulation_.revision())
    table_ = {simulation_.revision(),
              compare::TableContents(shown_geometry(), world().positions(), world().collision())};
  return table_.value;
}

const std::vector<collide::BucketLoad>& DetectionInspector::fullest_buckets(std::uint32_t run) const {
  const collide::DebugGeometry& table = shown_geometry();
  assert(table.buckets > 0);
  if (fullest_.revision == simulation_.revision() && fullest_of_ == run) return fullest_.value;
  fullest_ = {simulation_.revision(), std::vector<collide::BucketLoad>((table.buckets - 1) / run + 1)};
  fullest_of_ = run;
  for (std::uint32_t i = 0; i < fullest_.value.size(); ++i) fullest_.value[i] = {.bucket = i * run, .load = 0};
  for (const collide::BucketLoad& entry : table.loads) {
    collide::BucketLoad& of_run = fullest_.value[entry.bucket / run];
    if (entry.load > of_run.load || (entry.load == of_run.load && entry.bucket < of_run.bucket)) of_run = entry;
  }
  return fullest_.value;
}

void DetectionInspector::select_bucket(std::optional<std::uint32_t> bucket) {
  const bool exists = bucket && *bucket < world().collision().buckets;
  selected_bucket_ = exists ? bucket : std::nullopt;
  selected_cell_.reset();
}

const compare::BucketContents* DetectionInspector::bucket() const {
  if (!selected_bucket_ || shown_geometry().buckets == 0) return nullptr;
  const std::uint64_t revision = simulation_.revision();
  if (table_.revision != revision || bucket_.revision != revision || bucket_.value.bucket != *selected_bucket_)
    bucket_ = {revision, table().bucket(*selected_bucket_)};
  return &bucket_.value;
}

std::vector<collide::DebugGeometry::Box> DetectionInspector::search_areas() const {
  const collide::Method& exact = *collide::find_method(collide::default_method);
  const collide::Frame frame = world().positions();
  if (window_work(world(), exact, world().collision()).cost() > max_window_work) return {};
  try {
    collide::Workers alone(1);
    collide::Result unused;
    exact_->forget();
    exact_->detect(frame, world().collision(), alone, unused);
    return exact_->debug().boxes;
  } catch (const std::exception&) {  // too little memory, or more contacts than it may report
    return {};
  }
}

const std::vector<softbody::SurfaceContactPoint>& DetectionInspector::surface_contacts() const {
  if (surface_contacts_.revision != simulation_.revision()) {
    surface_contacts_ = {.revision = simulation_.revision()};
    if (const softbody::World* world = simulation_.simulated(half_))
      surface_contacts_.value = world->surface_contacts();
  }
  return surface_contacts_.value;
}

}  // namespace app::session
