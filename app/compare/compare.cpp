#include "app/compare/compare.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "app/base/timings.h"

namespace app::compare {
namespace {

CompareRow scored(const collide::Result& found, const std::vector<collide::Contact>& truth, CompareRow row) {
  row.scored = true;
  row.counters = found.counters;
  row.coverage = found.coverage;
  row.contacts = found.contacts.size();
  static_cast<Score&>(row) = score(found.contacts, truth);
  return row;
}

}  // namespace

std::size_t method_index(std::string_view key) {
  const collide::Method* method = collide::find_method(key);
  assert(method);
  return static_cast<std::size_t>(method - collide::method_table().data());
}

std::optional<std::size_t> choose_reference(const collide::Method& beside,
                                            const std::function<bool(std::size_t)>& can_run) {
  const std::size_t brute_force = method_index(collide::reference_method);
  if (can_run(brute_force)) return brute_force;
  for (std::size_t i = 0; i < collide::method_table().size(); ++i) {
    const collide::Method& method = collide::method_table()[i];
    const bool shares_levels = method.uses_levels == beside.uses_levels;
    const bool shares_hash = method.uses_hash && (method.uses_levels || beside.uses_hash);
    if (method.exact && !shares_levels && !shares_hash && i != brute_force && can_run(i)) return i;
  }
  return std::nullopt;
}

CompareReport Comparison::run(const FrameSnapshot& snapshot, const std::stop_token& stop) {
  if (world_ != snapshot.world) entries_.clear();  // the detectors of another world may hold much memory
  world_ = snapshot.world;
  for (const collide::Method& method : collide::method_table().subspan(entries_.size()))
    entries_.push_back({.detector = method.make(), .result = {}, .error = {}});
  CompareReport report;
  report.id = snapshot.id;
  report.frame = snapshot.frame_number;
  report.rows.resize(entries_.size());
  for (Entry& entry : entries_) entry.done = false;
  cost_model_.begin(snapshot.view(), snapshot.settings, snapshot.world);
  cost_model_.learn(snapshot.driver, snapshot.found.counters);

  report.order = choose(snapshot, report);
  std::ranges::shuffle(report.order, random_);
  for (const std::size_t method : report.order) {
    if (stop.stop_requested()) return report;
    detect(method, snapshot);
    CompareRow& row = report.rows[method];
    if (entries_[method].done) row.ms = entries_[method].ms;
    row.not_run = entries_[method].error;
  }
  report.reference = find_reference(snapshot, report.reference_note);
  if (report.reference && !entries_[*report.reference].done) detect(*report.reference, snapshot);
  score(snapshot, report);
  return report;
}

/// Returns the methods to time, in the order of the table. Brute force is not among them: it only serves as the
/// reference.
std::vector<std::size_t> Comparison::choose(const FrameSnapshot& snapshot, CompareReport& report) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < snapshot.chosen.size(); ++i) {
    if (!snapshot.chosen[i]) continue;
    if (const WorkEstimate work = cost_model_.of(i); work.cost() > budget_) {
      report.rows[i].not_run = "not run: " + work.in_words() + " predicted";
    } else if (collide::method_table()[i].key != collide::reference_method) {
      order.push_back(i);
    }
  }
  return order;
}

void Comparison::detect(std::size_t method, const FrameSnapshot& snapshot) {
  Entry& entry = entries_[method];
  entry.error.clear();
  try {
    entry.detector->forget();  // all methods search from scratch
    entry.ms = time_ms([&] { entry.detector->detect(snapshot.view(), snapshot.settings, alone_, entry.result); });
    entry.done = true;
    cost_model_.learn(method, entry.result.counters);
  } catch (const std::exception& error) {  // out of memory, or more contacts than a detector may report
    entry.error = std::string("not run: ") + error.what();
  }
}

std::optional<std::size_t> Comparison::find_reference(const FrameSnapshot& snapshot,
                                                      std::string& reference_note) const {
  if (const WorkEstimate work = cost_model_.of(method_index(collide::reference_method)); work.cost() > budget_)
    reference_note = "brute force would take " + work.in_words();
  return choose_reference(collide::method_table()[snapshot.driver], [&](std::size_t i) {
    return i < entries_.size() && (entries_[i].done || cost_model_.of(i).cost() <= budget_);
  });
}

void Comparison::score(const FrameSnapshot& snapshot, CompareReport& report) const {
  if (!report.reference) return;
  const Entry& reference = entries_[*report.reference];
  if (!reference.done) {  // it threw
    report.reference_note = reference.error;
    report.reference.reset();
    return;
  }
  const std::vector<collide::Contact>& truth = reference.result.contacts;
  report.true_contacts = truth.size();
  report.reference_ms = reference.ms;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    CompareRow& row = report.rows[i];
    if (i == snapshot.driver) {
      row = scored(snapshot.found, truth, std::move(row));
      if (entries_[i].done) row.counters = entries_[i].result.counters;  // of the search from scratch that was timed
    } else if (entries_[i].done) {
      row = scored(entries_[i].result, truth, std::move(row));
    }
  }
}

}  // namespace app::compare
