#include "collide/core/workers.h"

#include <atomic>
#include <barrier>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <optional>
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
  std::mutex mutex;
  std::condition_variable wake, done;
  const std::function<void(int)>* task = nullptr;
  std::uint64_t run_number = 0;  // a change wakes the threads
  int busy = 0;                  // threads other than the caller that have not finished the run
  bool stopping = false;
  std::exception_ptr error;  // the first one of the run
  std::atomic<bool> failed = false;
  std::optional<std::barrier<>> barrier;
  std::vector<std::jthread> threads;  // last, so that they are joined before the rest goes

  void perform(int thread) {
    try {
      (*task)(thread);
    } catch (const Cancelled&) {
      barrier->arrive_and_drop();
    } catch (...) {
      {
        const std::lock_guard lock(mutex);
        if (!error) error = std::current_exception();
      }
      failed = true;
      barrier->arrive_and_drop();  // the others must not wait for this thread
    }
  }

  void serve(int thread) {
    std::uint64_t seen = 0;
    for (;;) {
      {
        std::unique_lock lock(mutex);
        wake.wait(lock, [&] { return stopping || run_number != seen; });
        if (stopping) return;
        seen = run_number;
      }
      perform(thread);
      const std::lock_guard lock(mutex);
      if (--busy == 0) done.notify_one();
    }
  }

  void stop() {
    {
      const std::lock_guard lock(mutex);
      stopping = true;
    }
    wake.notify_all();
    threads.clear();
  }
};

Workers::Workers(int threads) : threads_(threads), shared_(std::make_unique<Shared>()) {
  if (threads < 1) throw std::invalid_argument("Workers: at least one thread");
  shared_->barrier.emplace(threads);
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
  {
    const std::lock_guard lock(shared.mutex);
    shared.task = &task;
    shared.busy = threads_ - 1;
    ++shared.run_number;
  }
  shared.wake.notify_all();
  shared.perform(0);
  std::unique_lock lock(shared.mutex);
  shared.done.wait(lock, [&] { return shared.busy == 0; });
  if (!shared.failed) return;

  shared.failed = false;
  shared.barrier.emplace(threads_);  // the failed threads have left the old one for good
  std::rethrow_exception(std::exchange(shared.error, nullptr));
}

void Workers::barrier() {
  shared_->barrier->arrive_and_wait();
  if (shared_->failed) throw Cancelled();
}

}  // namespace collide
