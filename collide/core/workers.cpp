#include "collide/core/workers.h"

#include <atomic>
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

/// Waits while `value` is `old`. To be woken from sleep takes many times as long as most waits here last.
void wait_while(const std::atomic<std::uint32_t>& value, std::uint32_t old) {
  constexpr int looks = 200;  // about as long as it takes to be woken
  for (int i = 0; i < looks; ++i) {
    if (value != old) return;
    std::this_thread::yield();
  }
  value.wait(old);
}
}  // namespace

struct Workers::Shared {
  const std::function<void(int)>* task = nullptr;  // none: the threads are to end
  std::atomic<std::uint32_t> run_number = 0;       // a change wakes the threads
  std::atomic<std::uint32_t> busy = 0;             // threads other than the caller that have not finished the run
  std::atomic<std::uint32_t> barriers = 0;         // that all have reached, or left because a task has failed
  std::atomic<std::uint32_t> arrived = 0;          // at the next barrier
  std::atomic<bool> failed = false;
  std::mutex mutex;
  std::exception_ptr error;           // the first one of the run
  std::vector<std::jthread> threads;  // last, so that they are joined before the rest goes

  void perform(int thread) {
    try {
      (*task)(thread);
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

  void begin_run(const std::function<void(int)>* next) {
    task = next;
    ++run_number;
    run_number.notify_all();
  }

  void serve(int thread) {
    for (std::uint32_t seen = 0;; ++seen) {
      wait_while(run_number, seen);
      if (!task) return;
      perform(thread);
      if (--busy == 0) busy.notify_one();
    }
  }

  void stop() {
    begin_run(nullptr);
    threads.clear();
  }
};

Workers::Workers(int threads) : threads_(threads), shared_(std::make_unique<Shared>()) {
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

void Workers::run(const std::function<void(int thread)>& task) {
  Shared& shared = *shared_;
  shared.busy = static_cast<std::uint32_t>(threads_ - 1);
  shared.begin_run(&task);
  shared.perform(0);
  for (std::uint32_t busy; (busy = shared.busy) != 0;) wait_while(shared.busy, busy);
  if (!shared.failed) return;

  shared.failed = false;
  shared.arrived = 0;
  std::rethrow_exception(std::exchange(shared.error, nullptr));
}

void Workers::barrier() {
  Shared& shared = *shared_;
  const std::uint32_t before = shared.barriers;  // read first: a thread that fails from here on changes it
  if (shared.failed) throw Cancelled();
  if (++shared.arrived == static_cast<std::uint32_t>(threads_)) {
    shared.arrived = 0;
    shared.pass_barrier();
  } else {
    wait_while(shared.barriers, before);
  }
  if (shared.failed) throw Cancelled();
}

}  // namespace collide
