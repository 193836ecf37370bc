#include "collide/core/workers.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <mutex>
#include <span>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace collide {

namespace {
/// Thrown by barrier() where another thread's task has failed; never leaves run_together().
struct Cancelled {};

int processors() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }
}  // namespace

struct Workers::Shared {
  using Clock = std::chrono::steady_clock;
  /// used: how many threads run at the same time. If they share processors, those that look for work would take them
  /// from those that they wait for: they sleep at once.
  Shared(int all_threads, int used)
      : looking_time(used <= processors() ? 50 : 0), run_number(static_cast<std::size_t>(all_threads) - 1) {}

  const std::chrono::microseconds looking_time;    // before they sleep: about as long as it takes to be woken
  std::mutex mutex;                                // of task, members, by_all, stopping and error
  const std::function<void(int)>* task = nullptr;  // none: it is too late to take part
  int members = 0;                                 // threads that may take part: those with lower numbers
  bool by_all = true;                              // all of them take part; else those that come in time
  bool stopping = false;
  int caution = 0, runs_alone = 0;          // see note_wait(); the latter: runs to come
  std::exception_ptr error;                 // the first one of the run
  std::atomic<std::uint32_t> at_work = 0;   // helpers that do their part, or will if it is by all
  std::atomic<std::uint32_t> barriers = 0;  // that all have reached, or left because a task has failed
  std::atomic<std::uint32_t> arrived = 0;   // at the next barrier
  std::atomic<bool> failed = false;
  std::vector<std::atomic<std::uint32_t>> run_number;  // of each thread from thread 1 on: a change wakes it
  std::vector<std::jthread> threads;                   // last, so that they are joined before the rest goes

  /// Waits while `value` is `old`. No result depends on the clock.
  void wait_while(const std::atomic<std::uint32_t>& value, std::uint32_t old) const {
    const auto end = Clock::now() + looking_time;
    do {
      for (int look = 0; look < 100; ++look)
        if (value != old) return;
    } while (Clock::now() < end);
    value.wait(old);
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
    barriers.notify_all();
  }

  void serve(int thread) {
    const std::atomic<std::uint32_t>& own = run_number[static_cast<std::size_t>(thread) - 1];
    for (std::uint32_t seen = 0;;) {
      wait_while(own, seen);
      const std::function<void(int)>* part = nullptr;
      {
        const std::lock_guard lock(mutex);
        if (stopping) return;
        seen = own;
        if (thread < members) part = task;  // else it comes so late that others run
        if (part && !by_all) ++at_work;
      }
      if (!part) continue;
      perform(*part, thread);
      if (--at_work == 0) at_work.notify_one();
    }
  }

  void stop() {
    {
      const std::lock_guard lock(mutex);
      stopping = true;
      for (std::atomic<std::uint32_t>& number : run_number) ++number;
    }
    for (std::atomic<std::uint32_t>& number : run_number) number.notify_one();
    threads.clear();
  }

  void wait_for_others() {
    for (std::uint32_t others; (others = at_work) != 0;) wait_while(at_work, others);
  }

  /// Where other programs take the processor from a helper in the midst of its work, the caller waits for milliseconds.
  /// Then it works alone for a while, which grows with each such wait: no result depends on who does the work.
  void note_wait(Clock::duration own, Clock::duration waited) {
    const bool is_long = waited > 2 * own + std::chrono::microseconds(100);
    caution = is_long ? std::min(2 * caution + 64, 1024) : caution / 2;
    if (is_long) runs_alone = caution;
  }

  /// The caller's thread takes part.
  void run(int number, const std::function<void(int)>& next, bool all) {
    assert(at_work == 0);
    const std::span called = std::span(run_number).first(static_cast<std::size_t>(number) - 1);
    {
      const std::lock_guard lock(mutex);
      task = &next;
      members = number;
      by_all = all;
      if (all) at_work = static_cast<std::uint32_t>(called.size());
      for (std::atomic<std::uint32_t>& helper : called) ++helper;
    }
    for (std::atomic<std::uint32_t>& helper : called) helper.notify_one();
    const auto start = Clock::now();
    perform(next, 0);
    const auto own = Clock::now() - start;
    if (all) wait_for_others();
    {
      const std::lock_guard lock(mutex);
      task = nullptr;
    }
    wait_for_others();
    if (!all) note_wait(own, Clock::now() - start - own);
    if (!failed) return;
    failed = false;
    arrived = 0;
    std::rethrow_exception(std::exchange(error, nullptr));
  }
};

Workers::Workers(int threads, double least)
    : threads_(threads), useful_threads_(least > 0 ? std::min(threads, processors()) : threads), least_share_(least) {
  if (threads < 1) throw std::invalid_argument("Workers: at least one thread");
  shared_ = std::make_unique<Shared>(threads, useful_threads_);
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

int Workers::threads_for(double work) const {
  if (least_share_ <= 0) return useful_threads_;
  return static_cast<int>(std::clamp(work / least_share_, 1.0, static_cast<double>(useful_threads_)));
}

void Workers::share(int threads, std::size_t count, const std::function<void(int thread, std::size_t item)>& use) {
  assert(threads >= 1 && threads <= threads_);
  const bool alone = threads > 1 && shared_->runs_alone > 0;
  if (alone) --shared_->runs_alone;
  if (threads == 1 || count < 2 || alone) {
    for (std::size_t item = 0; item < count; ++item) use(0, item);
    return;
  }
  std::atomic<std::size_t> next = 0;
  const auto take_items = [&](int thread) {
    for (std::size_t item; (item = next++) < count;) use(thread, item);
  };
  shared_->run(threads, take_items, false);
}

void Workers::run(int parts, const std::function<void(int part)>& task) {
  share(parts, static_cast<std::size_t>(parts), [&](int, std::size_t part) { task(static_cast<int>(part)); });
}

void Workers::run_together(int threads, const std::function<void(int thread)>& task) {
  assert(threads >= 1 && threads <= threads_);
  shared_->run(threads, task, true);
}

void Workers::barrier() {
  Shared& shared = *shared_;
  assert(shared.by_all);
  const std::uint32_t before = shared.barriers;  // read first: a thread that fails from here on changes it
  if (shared.failed) throw Cancelled();
  if (++shared.arrived == static_cast<std::uint32_t>(shared.members)) {
    shared.arrived = 0;
    shared.pass_barrier();
  } else {
    shared.wait_while(shared.barriers, before);
  }
  if (shared.failed) throw Cancelled();
}

}  // namespace collide
