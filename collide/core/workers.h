#pragma once
// A pool of threads. Callers store their results so that it does not show which thread did what.

#include <cassert>
#include <cstddef>
#include <functional>
#include <memory>

namespace collide {

class Workers {
 public:
  /// Starts threads - 1 threads: the caller's own thread is one of them. The threads sleep while there is nothing to
  /// run. Throws std::invalid_argument if threads < 1.
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  int threads() const { return threads_; }

  /// Calls task(thread) once on each of threads() threads; thread 0 is the caller. Returns when all tasks have
  /// returned. If a task throws, run() rethrows the first exception after all tasks have returned. The other tasks run
  /// on until their next barrier(), which then throws too: do not catch that exception. Not reentrant; only one thread
  /// may call it at a time.
  void run(const std::function<void(int thread)>& task);

  /// Calls use(thread, item) once for each item below `count`, in any order: on the caller's thread, and on those
  /// others that wake up before it is done. It waits for no thread that has not woken up. `use` must not call
  /// barrier(). If a call throws, share() rethrows the first exception; some items may then have been left out. Not
  /// reentrant, as run().
  void share(std::size_t count, const std::function<void(int thread, std::size_t item)>& use);

  /// Waits until every thread of the current run() has called it. Only for use inside a task, by all threads.
  void barrier();

 private:
  struct Shared;
  int threads_;
  std::unique_ptr<Shared> shared_;
};

/// One thread's share [begin, end) of `count` items. The shares are consecutive, and their sizes differ by at most one.
struct Part {
  std::size_t begin, end;
};
inline Part part_of(std::size_t count, int thread, int threads) {
  assert(thread >= 0 && thread < threads);
  const auto t = static_cast<std::size_t>(thread), n = static_cast<std::size_t>(threads);
  return {count * t / n, count * (t + 1) / n};
}

}  // namespace collide
