#include "app/compare_worker.h"

#include <chrono>
#include <utility>

namespace app {
namespace {

constexpr std::uint32_t seed = 1;  // of the shuffled order: every run of the demo shuffles alike

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Too little memory for a comparison must not end the demo: its report says so instead.
CompareReport compare(Comparison& comparison, const Snapshot& snapshot, const std::stop_token& stop) {
  try {
    return comparison.run(snapshot, stop);
  } catch (const std::exception& error) {
    CompareReport report;
    report.id = snapshot.id;
    report.stands_in = std::string("the comparison failed: ") + error.what();
    report.rows.resize(collide::methods().size());
    return report;
  }
}

}  // namespace

CompareWorker::CompareWorker() : thread_([this](const std::stop_token& stop) { work(stop); }) {}

bool CompareWorker::ready() const {
  const std::scoped_lock lock(mutex_);
  return !busy_ && !waiting_ && now() >= rest_until_;
}

void CompareWorker::offer(Snapshot snapshot) {
  {
    const std::scoped_lock lock(mutex_);
    if (busy_ || waiting_) return;
    waiting_ = std::move(snapshot);
  }
  wake_.notify_one();
}

std::optional<CompareReport> CompareWorker::take() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(done_, std::nullopt);
}

void CompareWorker::work(const std::stop_token& stop) {
  Comparison comparison(seed);
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [this] { return waiting_.has_value(); })) {
    const Snapshot snapshot = std::move(*waiting_);
    waiting_.reset();
    busy_ = true;
    lock.unlock();
    const double start = now();
    CompareReport report = compare(comparison, snapshot, stop);
    const double end = now();
    lock.lock();
    done_ = std::move(report);
    busy_ = false;
    rest_until_ = end + 2 * (end - start);
  }
}

}  // namespace app
