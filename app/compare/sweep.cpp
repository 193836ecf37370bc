#include "app/compare/sweep.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

#include "app/base/heap.h"
#include "app/base/text.h"
#include "app/compare/score.h"

namespace app::compare {
namespace {

/// Returns the values of an axis; `otherwise` alone if the method does not use the axis.
template <class Values, class Value>
std::vector<Value> axis(bool used, const Values& values, Value otherwise) {
  return used ? std::vector<Value>(values.begin(), values.end()) : std::vector<Value>{otherwise};
}

}  // namespace

std::vector<Configuration> sweep_configurations(const collide::Settings& settings,
                                                const std::function<glm::vec3(int levels)>& automatic_cell_size,
                                                const MethodSet& methods) {
  std::vector<Configuration> all;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    if (!methods[m]) continue;
    const collide::Method& method = collide::method_table()[m];
    for (const int levels : axis(method.uses_levels, sweep_levels, settings.levels)) {
      const glm::vec3 automatic = automatic_cell_size(levels);
      for (const std::uint32_t buckets : axis(method.uses_hash, sweep_buckets, settings.buckets)) {
        for (const double cell : axis(method.uses_hash, sweep_cells, 1.0)) {
          Configuration& c = all.emplace_back(Configuration{m, settings, cell});
          c.settings.levels = levels;
          c.settings.buckets = buckets;
          c.settings.cell_size = automatic * static_cast<float>(cell);
        }
      }
    }
  }
  return all;
}

std::vector<Configuration> sweep_configurations(const softbody::BodiesInMotion& world, const MethodSet& methods) {
  return sweep_configurations(
      world.collision(), [&](int levels) { return world.automatic_cell_size(levels); }, methods);
}

Sweep::Sweep(const collide::Frame& frame, const std::vector<Configuration>& configurations, const SweepLimits& limits,
             collide::Workers& workers)
    : frame_(frame), limits_(limits), workers_(workers), random_(1) {
  assert(collide::is_complete(frame));
  for (const collide::Method& method : collide::method_table()) detectors_.push_back(method.make());
  CostModel cost_model;
  for (const Configuration& c : configurations) {
    SweepRow& row = report_.rows.emplace_back();
    row.configuration = c;
    cost_model.begin(frame_, c.settings, 0);
    const WorkEstimate work = cost_model.of(c.method);
    predicted_.push_back(work.cost());
    if (work.cost() > limits_.budget) row.not_run = "over budget: " + work.in_words() + " predicted";
  }
}

bool Sweep::step() {
  if (round_ < 0) {
    find_reference();
    next_round();
    return true;
  }
  while (order_.empty()) {
    if (round_ == limits_.repetitions) return false;
    next_round();
  }
  SweepRow& row = report_.rows[order_.back()];
  order_.pop_back();
  try {
    round_ == 0 ? check(row) : time(row);
  } catch (const std::exception& error) {  // out of memory, or more contacts than a detector may report
    row.checked = false;
    row.times.ms.clear();
    row.not_run = failure_text(error);
  }
  return true;
}

double Sweep::progress() const {
  const auto rows = static_cast<double>(report_.rows.size());
  const double rounds = 1.0 + limits_.repetitions;
  if (round_ < 0 || rows == 0) return 0;
  return (round_ + (rows - static_cast<double>(order_.size())) / rows) / rounds;
}

void Sweep::find_reference() {
  try {
    const std::optional<Configuration> c = choose_reference();
    if (!c) return;
    collide::method_table()[c->method].make()->detect(frame_, c->settings, workers_, result_);
    truth_ = result_.contacts;
    report_.true_contacts = truth_.size();
    report_.reference = c;
  } catch (const std::exception& error) {  // out of memory, or more contacts than a detector may report
    report_.reference_note = failure_text(error);
  }
}

/// Returns brute force if it is within the budget; else the exact configuration with the least predicted work. Methods
/// without levels and without a hash come first: they share the least code with the others.
std::optional<Configuration> Sweep::choose_reference() {
  std::optional<std::size_t> best;
  const auto rank = [&](std::size_t i) {
    const collide::Method& method = collide::method_table()[report_.rows[i].configuration.method];
    return std::pair(int{method.uses_levels} + int{method.uses_hash}, predicted_[i]);
  };
  for (std::size_t i = 0; i < report_.rows.size(); ++i) {
    const SweepRow& row = report_.rows[i];
    const collide::Method& method = collide::method_table()[row.configuration.method];
    if (method.key == collide::reference_method) {
      if (row.not_run.empty()) return row.configuration;
      report_.reference_note = "brute force is " + row.not_run;
    }
    if (method.exact && row.not_run.empty() && (!best || rank(i) < rank(*best))) best = i;
  }
  return best ? std::optional(report_.rows[*best].configuration) : std::nullopt;
}

void Sweep::next_round() {
  ++round_;
  order_.clear();
  for (std::size_t i = 0; i < report_.rows.size(); ++i) {
    const SweepRow& row = report_.rows[i];
    if (row.not_run.empty() && row.times.total() < limits_.repeat_ms) order_.push_back(i);
  }
  std::ranges::shuffle(order_, random_);
}

void Sweep::check(SweepRow& row) {
  const Configuration& c = row.configuration;
  collide::Result result;
  const std::size_t before = heap_in_use();
  const auto detector = collide::method_table()[c.method].make();
  detector->detect(frame_, c.settings, workers_, result);
  row.memory = std::max(heap_in_use(), before) - before;
  row.counters = result.counters;
  row.skipped = result.skipped;
  row.coverage = result.coverage;
  row.contacts = result.contacts.size();
  if (report_.reference) {
    const Score against = score(result.contacts, truth_);
    row.missed = against.missed.size();
    row.recall = against.recall;
    row.precision = against.precision;
  }
  row.checked = true;
}

void Sweep::time(SweepRow& row) {
  const Configuration& c = row.configuration;
  collide::Detector& detector = *detectors_[c.method];
  detector.forget();
  detector.detect(frame_, c.settings, workers_, result_);
  const double before = process_seconds();
  const double wall_ms =
      time_ms([&] { row.times.ms.push_back(timed_fresh_search(detector, frame_, c.settings, workers_, result_)); });
  if (result_.own_ms) return;  // in another process, perhaps
  report_.timed += {.wall = 1e-3 * wall_ms, .processor = process_seconds() - before};
}

std::vector<std::size_t> pareto_front(const std::vector<Tradeoff>& points) {
  std::vector<std::size_t> order(points.size()), front;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return std::pair(points[a].ms, points[a].error) < std::pair(points[b].ms, points[b].error);
  });
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order)
    if (points[i].error < least) front.push_back(i), least = points[i].error;
  return front;
}

}  // namespace app::compare
