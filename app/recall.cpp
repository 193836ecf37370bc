#include "app/recall.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

namespace app {
namespace {

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

RecallRow score(const Candidate& candidate, const std::vector<collide::Contact>& reference) {
  RecallRow row;
  row.method = candidate.method;
  std::ranges::set_difference(reference, candidate.contacts, std::back_inserter(row.missed));
  std::ranges::set_difference(candidate.contacts, reference, std::back_inserter(row.extra));
  if (!reference.empty()) {
    row.recall = static_cast<double>(reference.size() - row.missed.size()) / static_cast<double>(reference.size());
  }
  return row;
}

RecallReport compare_or_say_why(const Snapshot& snapshot) {
  try {
    return compare(snapshot);
  } catch (const std::exception& error) {  // out of memory, or more contacts than a detector may report
    RecallReport report;
    report.id = snapshot.id;
    report.skipped = std::string("not measured: ") + error.what();
    return report;
  }
}

}  // namespace

std::uint64_t predicted_pair_tests(const collide::Bodies& bodies, bool self_collision) {
  const auto pairs = [](std::uint64_t n) { return n * (n - (n > 0)) / 2; };
  std::uint64_t tests = pairs(bodies.vertex_count());
  if (self_collision) return tests;
  for (collide::Index b = 0; b < bodies.count(); ++b) tests -= pairs(bodies.size(b));
  return tests;
}

std::string refusal(const collide::Bodies& bodies, bool self_collision) {
  constexpr std::uint64_t most = 1'000'000'000;
  const std::uint64_t tests = predicted_pair_tests(bodies, self_collision);
  if (tests <= most) return {};
  return "not measured: brute force would take " + std::to_string(tests / 1'000'000) + " million pair tests";
}

RecallReport compare(const Snapshot& snapshot) {
  RecallReport report;
  report.id = snapshot.id;
  collide::Workers alone(1);
  collide::Result truth;
  const double start = now();
  collide::find_method("brute-force")
      ->make()
      ->detect({snapshot.x, snapshot.y, snapshot.z, &snapshot.bodies}, snapshot.settings, alone, truth);
  report.reference_ms = (now() - start) * 1e3;
  report.reference = truth.contacts.size();
  for (const Candidate& candidate : snapshot.found) report.rows.push_back(score(candidate, truth.contacts));
  return report;
}

RecallWorker::RecallWorker() : thread_([this](const std::stop_token& stop) { work(stop); }) {}

bool RecallWorker::ready() const {
  const std::scoped_lock lock(mutex_);
  return !busy_ && !waiting_ && now() >= rest_until_;
}

void RecallWorker::offer(Snapshot snapshot) {
  {
    const std::scoped_lock lock(mutex_);
    if (busy_ || waiting_) return;
    waiting_ = std::move(snapshot);
  }
  wake_.notify_one();
}

std::optional<RecallReport> RecallWorker::take() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(done_, std::nullopt);
}

void RecallWorker::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [this] { return waiting_.has_value(); })) {
    const Snapshot snapshot = std::move(*waiting_);
    waiting_.reset();
    busy_ = true;
    lock.unlock();
    const double start = now();
    RecallReport report = compare_or_say_why(snapshot);
    const double end = now();
    lock.lock();
    done_ = std::move(report);
    busy_ = false;
    rest_until_ = end + 2 * (end - start);
  }
}

}  // namespace app
