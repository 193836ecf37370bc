// Session: what is shown of the methods' inner picture, boxes, cells and buckets.

#include "app/session/session.h"

namespace app {

void Session::select_bucket(std::optional<std::uint32_t> bucket) {
  const bool exists = bucket && *bucket < world_->collision().buckets;
  selected_bucket_ = exists ? bucket : std::nullopt;
  selected_cell_.reset();
}

const collide::Method& Session::shown_method() const {
  return world_->method().uses_hash ? world_->method() : *collide::find_method(collide::paper_method);
}

const collide::DebugGeometry& Session::debug() const {
  if (!world_->method().uses_hash) {
    debug_ = {};  // a table may be large
    return paper();
  }
  if (debug_.revision != revision_) debug_ = {revision_, world_->detector().debug()};
  return debug_.value;
}

const collide::DebugGeometry& Session::paper() const {
  if (world_->method().key == collide::paper_method) return debug();
  constexpr collide::Index most_moving = 100'000;  // vertices: some 10 ms a picture
  const bool affordable = paused || world_->all_at_rest() || world_->bodies().vertex_count() <= most_moving;
  const bool was_refused = affordable && paper_.value.buckets == 0;
  if (paper_.revision == revision_ && !was_refused) return paper_.value;
  paper_ = {revision_, {}};
  if (!affordable) return paper_.value;
  collide::Workers alone(1);
  paper_.value = paper_structure_(world_->positions(), world_->collision(), alone);
  table_.revision = 0;
  return paper_.value;
}

const TableContents& Session::table() const {
  if (table_.revision != revision_)
    table_ = {revision_, TableContents(debug(), world_->positions(), world_->collision())};
  return table_.value;
}

const BucketContents* Session::bucket() const {
  if (!selected_bucket_ || debug().buckets == 0) return nullptr;
  if (table_.revision != revision_ || bucket_.revision != revision_ || bucket_.value.bucket != *selected_bucket_)
    bucket_ = {revision_, table().bucket(*selected_bucket_)};
  return &bucket_.value;
}

std::vector<collide::DebugGeometry::Box> Session::areas() const {
  const collide::Method& exact = *collide::find_method(collide::default_method);
  if (work_of(exact, world_->collision()).cost() > most_work) return {};
  try {
    collide::Workers alone(1);
    collide::Result unused;
    exact_->forget();
    exact_->detect(world_->positions(), world_->collision(), alone, unused);
    return exact_->debug().boxes;
  } catch (const std::exception&) {  // out of memory, or more contacts than it may report
    return {};
  }
}

}  // namespace app
