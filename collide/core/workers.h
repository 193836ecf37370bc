#pragma once
// Threads that wait for work. No clock and no work stealing: who does what depends on nothing but the thread count, and
// callers write results so that not even that shows.

#include <functional>
#include <memory>

namespace collide {

class Workers {
 public:
  /// threads >= 1, else std::invalid_argument; the caller's own thread included: Workers(1) starts none. The threads
  /// sleep while there is nothing to run.
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  int threads() const { return threads_; }

  /// Calls task(thread) once on each of `threads()` threads, thread 0 being the caller, and returns when all are done.
  /// The first exception thrown by a task is rethrown here, after all have returned; the other tasks run on until their
  /// next barrier(), which then throws as well, so that none waits for ever or goes on with half of the data. Let what
  /// barrier() throws pass. Not reentrant, and to be called by one thread at a time.
  void run(const std::function<void(int thread)>& task);

  /// Waits until every thread of the current run() has got here. Only inside a task, and by all threads alike.
  void barrier();

 private:
  struct Shared;
  int threads_;
  std::unique_ptr<Shared> shared_;
};

/// The part [begin, end) of count items that falls to one thread: contiguous, in order, sizes differ by at most one.
struct Part {
  std::size_t begin, end;
};
inline Part part_of(std::size_t count, int thread, int threads) {
  const auto t = static_cast<std::size_t>(thread), n = static_cast<std::size_t>(threads);
  return {count * t / n, count * (t + 1) / n};
}

}  // namespace collide
