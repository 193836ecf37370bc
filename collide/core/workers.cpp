#include "collide/core/workers.h"

#include <atomic>
#include <cassert>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace collide {

namespace {
/// Thrown by barrier() where another thread's task has failed; never leaves run().
struct Cancelled {};
}  // namespace

struct Workers::Shared {
  /// Threads that share processors would take them from those that they wait for: they sleep at once.
  explicit Shared(int all_threads)
      : looking_time(all_threads <= static_cast<int>(std::thread::hardware_concurrency()) ? 50 : 0) {}

  const std::chrono::microseconds looking_time;    // before they sleep: about as long as it takes to be woken
  std::mutex mutex;                                // of task, by_all, stopping and error
  const std::function<void(int)>* task = nullptr;  // none: it is too late to take part
  bool by_all = true;                              // all threads; else those that come in time
  bool stopping = false;
  std::exception_ptr error;                   // the first one of the run
  std::atomic<std::uint32_t> run_number = 0;  // a change wakes the threads
  std::atomic<std::uint32_t> at_work = 0;     // threads beside the caller's that do their part, or will if it is by all
  std::atomic<std::uint32_t> barriers = 0;    // that all have reached, or left because a task has failed
  std::atomic<std::uint32_t> arrived = 0;     // at the next barrier
  std::atomic<bool> failed = false;
  std::condition_variable begun, done, passed;  // a change of run_number, of at_work to 0, or of barriers
  std::vector<std::jthread> threads;            // last, so that they are joined before the rest goes

  /// Waits while `value` is `old`. No result depends on the clock.
  void wait_while(const std::atomic<std::uint32_t>& value, std::uint32_t old, std::condition_variable& changed) {
    const auto end = std::chrono::steady_clock::now() + looking_time;
    do {
      for (int look = 0; look < 100; ++look)
        if (value != old) return;
    } while (std::chrono::steady_clock::now() < end);
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return value != old; });
  }

  void wake_sleepers(std::condition_variable& changed) {
    { const std::lock_guard lock(mutex); }  // whoever has just looked in vain is asleep by now
    changed.notify_all();
  }

  void perform(const std::function<void(int)>& part, int thread) {
    try {
      part(thread);
    } catch (const Cancelled&) {
    } catch (...) {
      {
        const std::lock_guard lock(mutex);
        if (!error) error = std::current_exception();
      }
      failed = true;
      pass_barrier();  // the others must not wait for this thread
    }
  }

  void pass_barrier() {
    ++barriers;
    wake_sleepers(passed);
  }

  void serve(int thread) {
    for (std::uint32_t seen = 0;;) {
      wait_while(run_number, seen, begun);
      const std::function<void(int)>* part = nullptr;
      {
        const std::lock_guard lock(mutex);
        if (stopping) return;
        seen = run_number;
        part = task;
        if (part && !by_all) ++at_work;
      }
      if (!part) continue;
      perform(*part, thread);
      if (--at_work == 0) wake_sleepers(done);
    }
  }

  void stop() {
    {
      const std::lock_guard lock(mutex);
      stopping = true;
      ++run_number;
    }
    begun.notify_all();
    threads.clear();
  }

  void wait_for_others() {
    for (std::uint32_t others; (others = at_work) != 0;) wait_while(at_work, others, done);
  }

  /// The caller's thread takes part.
  void run(const std::function<void(int)>& next, bool all) {
    assert(at_work == 0);
    {
      const std::lock_guard lock(mutex);
      task = &next;
      by_all = all;
      if (all) at_work = static_cast<std::uint32_t>(threads.size());
      ++run_number;
    }
    begun.notify_all();
    perform(next, 0);
    if (all) wait_for_others();
    {
      const std::lock_guard lock(mutex);
      task = nullptr;
    }
    wait_for_others();
    if (!failed) return;
    failed = false;
    arrived = 0;
    std::rethrow_exception(std::exchange(error, nullptr));
  }
};

Workers::Workers(int threads) : threads_(threads), shared_(std::make_unique<Shared>(threads)) {
  if (threads < 1) throw std::invalid_argument("Workers: at least one thread");
  try {
    for (int thread = 1; thread < threads; ++thread) {
      shared_->threads.emplace_back([shared = shared_.get(), thread] { shared->serve(thread); });
    }
  } catch (...) {  // no more threads to be had
    shared_->stop();
    throw;
  }
}

Workers::~Workers() { shared_->stop(); }

void Workers::run(const std::function<void(int thread)>& task) { shared_->run(task, true); }

void Workers::share(std::size_t count, const std::function<void(int thread, std::size_t item)>& use) {
  if (threads_ == 1 || count < 2) {
    for (std::size_t item = 0; item < count; ++item) use(0, item);
    return;
  }
  std::atomic<std::size_t> next = 0;
  shared_->run(
      [&](int thread) {
        for (std::size_t item; (item = next++) < count;) use(thread, item);
      },
      false);
}

void Workers::barrier() {
  Shared& shared = *shared_;
  assert(shared.by_all);
  const std::uint32_t before = shared.barriers;  // read first: a thread that fails from here on changes it
  if (shared.failed) throw Cancelled();
  if (++shared.arrived == static_cast<std::uint32_t>(threads_)) {
    shared.arrived = 0;
    shared.pass_barrier();
  } else {
    shared.wait_while(shared.barriers, before, shared.passed);
  }
  if (shared.failed) throw Cancelled();
}

}  // namespace collide
