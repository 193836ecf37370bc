#include "app/compare/compare.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "app/base/text.h"

namespace app::compare {
namespace {

CompareRow scored(const collide::Result& found, const std::vector<collide::Contact>& truth, const collide::Frame& frame,
                  CompareRow row) {
  row.scored = true;
  row.counters = found.counters;
  row.coverage = found.coverage;
  row.contacts = found.contacts.size();
  static_cast<Score&>(row) = score(found.contacts, truth);
  if (!row.missed.empty()) row.missed_distance = distance(row.missed.front(), frame);
  if (row.first_false) row.false_distance = distance(*row.first_false, frame);
  return row;
}

CompareReport empty_report(const FrameSnapshot& snapshot) {
  CompareReport report;
  report.id = snapshot.id;
  report.frame = snapshot.frame_number;
  report.rows.resize(collide::method_table().size());
  return report;
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
    const bool shares_idea =
        (method.group == collide::MethodGroup::paper) == (beside.group == collide::MethodGroup::paper);
    const bool shares_hash = method.uses_hash && (method.uses_levels || beside.uses_hash);
    if (method.exact && !shares_idea && !shares_hash && i != brute_force && can_run(i)) return i;
  }
  return std::nullopt;
}

std::optional<CompareReport> Comparison::advance(const FrameSnapshot& snapshot,
                                                 const Background<Comparison>& background) {
  try {
    if (!report_) begin(snapshot);
    if (background.cancelled()) return std::exchange(report_, std::nullopt);
    if (timed_ < report_->order.size()) {
      detect(report_->order[timed_++], snapshot);
      return std::nullopt;
    }
    score(snapshot);
  } catch (const std::exception& error) {
    report_ = empty_report(snapshot);
    report_->reference_note = "the comparison failed: " + failure_text(error);
  }
  return std::exchange(report_, std::nullopt);
}

void Comparison::begin(const FrameSnapshot& snapshot) {
  if (world_ != snapshot.world) entries_.clear();  // the detectors of another world may hold much memory
  world_ = snapshot.world;
  for (const collide::Method& method : collide::method_table().subspan(entries_.size()))
    entries_.push_back({method.make()});
  report_ = empty_report(snapshot);
  for (Entry& entry : entries_) entry.ms.reset();
  cost_model_.begin(snapshot.view(), snapshot.settings, snapshot.world);
  cost_model_.learn(snapshot.driver, snapshot.found.counters);
  for (std::size_t i = 0; i < snapshot.chosen.size(); ++i) {
    if (!snapshot.chosen[i]) continue;
    if (const WorkEstimate work = cost_model_.of(i); work.cost() > budget_)
      report_->rows[i].not_run = "not run: " + work.in_words() + " predicted";
    else if (collide::method_table()[i].key != collide::reference_method)  // which is not timed
      report_->order.push_back(i);
  }
  std::ranges::shuffle(report_->order, random_);
  timed_ = 0;
}

void Comparison::detect(std::size_t method, const FrameSnapshot& snapshot) {
  Entry& entry = entries_[method];
  entry.error.clear();
  try {
    entry.ms = timed_fresh_search(*entry.detector, snapshot.view(), snapshot.settings, alone_, entry.result);
    cost_model_.learn(method, entry.result.counters);
  } catch (const std::exception& error) {  // out of memory, or more contacts than a detector may report
    entry.error = "not run: " + failure_text(error);
  }
}

std::optional<std::size_t> Comparison::find_reference(const FrameSnapshot& snapshot) {
  if (const WorkEstimate work = cost_model_.of(method_index(collide::reference_method)); work.cost() > budget_)
    report_->reference_note = "brute force would take " + work.in_words();
  const auto reference = choose_reference(collide::method_table()[snapshot.driver], [&](std::size_t i) {
    return i < entries_.size() && (entries_[i].ms || cost_model_.of(i).cost() <= budget_);
  });
  if (!reference || entries_[*reference].ms) return reference;
  detect(*reference, snapshot);
  if (entries_[*reference].ms) return reference;
  report_->reference_note = entries_[*reference].error;
  return std::nullopt;
}

void Comparison::score(const FrameSnapshot& snapshot) {
  for (const std::size_t method : report_->order) {
    report_->rows[method].ms = entries_[method].ms;
    report_->rows[method].not_run = entries_[method].error;
  }
  report_->reference = find_reference(snapshot);
  if (!report_->reference) return;
  const Entry& reference = entries_[*report_->reference];
  const std::vector<collide::Contact>& truth = reference.result.contacts;
  report_->true_contacts = truth.size();
  report_->reference_ms = *reference.ms;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    CompareRow& row = report_->rows[i];
    if (i == snapshot.driver) {
      row = scored(snapshot.found, truth, snapshot.view(), std::move(row));
      if (entries_[i].ms) row.counters = entries_[i].result.counters;  // of the search from scratch that was timed
    } else if (entries_[i].ms) {
      row = scored(entries_[i].result, truth, snapshot.view(), std::move(row));
    }
  }
}

}  // namespace app::compare
