#include "app/session/live/live_comparison.h"

#include <utility>

namespace app::session {

void LiveComparison::exchange(const softbody::BodiesInMotion& world, std::uint64_t revision, std::uint64_t world_number,
                              int rests) {
  auto report = comparison_.take();
  compare::add_new_methods(choice.methods);
  method_ms_.resize(choice.methods.size());
  sums_.resize(choice.methods.size());
  if (report && !std::exchange(outdated_, false) && report->id >= first_wanted_) keep(std::move(*report));
  if (!wants_report(revision) || !comparison_.ready(rests)) return;
  compare::FrameSnapshot snapshot;
  snapshot.id = revision;
  snapshot.frame_number = world.frame();
  snapshot.world = world_number;
  snapshot.copy(world.positions());
  snapshot.settings = world.collision();
  snapshot.driver = compare::method_index(world.method().key);
  snapshot.found = world.detection();
  snapshot.chosen = chosen();
  if (std::exchange(offered_, revision) != revision || snapshot.chosen != offered_methods_) offers_ = 0;
  offered_methods_ = snapshot.chosen;
  ++offers_;
  comparison_.offer(std::move(snapshot));
}

/// A world at rest has nothing new for the recall, but times want to be taken until their median is worth something.
bool LiveComparison::wants_report(std::uint64_t revision) const {
  if (offered_ != revision) return true;
  const compare::MethodSet wanted = chosen();
  return (!wanted.empty() && wanted != offered_methods_) || (choice.on && offers_ < times_per_state);
}

compare::MethodSet LiveComparison::shown_methods() const {
  compare::MethodSet methods = choice.methods;
  methods[driver_] = true;
  return methods;
}

/// Returns which methods are timed, the driver too where it is shown; empty if none is.
compare::MethodSet LiveComparison::chosen() const {
  compare::MethodSet methods;
  if (choice.on) methods = shown_methods();
  const auto add = [&](std::size_t method) {
    if (method == driver_) return;
    methods.resize(collide::method_table().size());
    methods[method] = true;
  };
  if (choice.with_paper) add(compare::method_index(collide::paper_method));
  if (choice.with_misses) add(choice.misses_of);
  return methods;
}

void LiveComparison::keep(compare::CompareReport report) {
  for (std::size_t i = 0; i < report.rows.size(); ++i) {
    const compare::CompareRow& row = report.rows[i];
    const bool counted = report.id == report_.id && i < report_.rows.size() && report_.rows[i].scored;
    if (!row.scored || counted) continue;
    ++sums_[i].frames;
    sums_[i].true_contacts += report.true_contacts;
    sums_[i].missed += row.missed.size();
  }
  report_ = std::move(report);
  ++reports_;
  if (const compare::CompareRow* row = driver_row()) recall_.push(report_.frame, static_cast<float>(row->recall));
  for (std::size_t i = 0; i < report_.rows.size(); ++i) {
    if (const auto ms = report_.rows[i].ms)
      method_ms_[i].push(report_.frame, static_cast<float>(*ms));
    else
      method_ms_[i].clear();
  }
}

void LiveComparison::restart(const softbody::BodiesInMotion& world, std::uint64_t revision) {
  report_ = {};
  settings_ = world.collision();
  driver_ = compare::method_index(world.method().key);
  first_wanted_ = revision;
  forget_times();
}

void LiveComparison::detection_changed(const softbody::BodiesInMotion& world, std::uint64_t revision) {
  driver_ = compare::method_index(world.method().key);
  recall_.clear();
  if (settings_ == world.collision()) return;
  settings_ = world.collision();
  first_wanted_ = revision;
  forget_times();
}

void LiveComparison::method_changed(std::size_t method) {
  outdated_ = comparison_.has_work();
  offered_ = 0;
  if (method >= sums_.size()) return;  // it was not compared yet
  sums_[method] = {};
  method_ms_[method].clear();
  if (method < report_.rows.size()) report_.rows[method].scored = false;
}

void LiveComparison::forget_times() {
  recall_.clear();
  sums_.assign(sums_.size(), {});
  for (TimeSeries& times : method_ms_) times.clear();
}

const compare::CompareRow* LiveComparison::scored_row(std::size_t method) const {
  return method < report_.rows.size() && report_.rows[method].scored ? &report_.rows[method] : nullptr;
}

}  // namespace app::session
