#pragma once
// A pool of threads. Callers store their results so that it does not show which thread did what.

#include <cassert>
#include <cstddef>
#include <functional>
#include <memory>

namespace collide {

class Workers {
 public:
  /// To hand work to a sleeping thread takes the caller about 5 us, so it gains nothing unless the thread is given much
  /// more than that.
  static constexpr double least_share = 1e5;  // ns

  /// Starts threads - 1 threads: the caller's own thread is one of them. The threads sleep while there is nothing to
  /// do. least_share (ns): of each thread, see threads_for(). Throws std::invalid_argument if threads < 1.
  explicit Workers(int threads, double least = least_share);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  int threads() const { return threads_; }

  /// Returns how many threads should share some work, from 1 to threads(): each is to have least_share of it at least,
  /// and a processor. With a least_share of 0 all threads share all work. This is the only rule that says what is
  /// shared. work: an estimate of the time that it takes one thread, ns, up to where the threads wait for each other.
  int threads_for(double work) const;

  // The functions below take a number of threads from 1 to threads(); thread 0 is the caller. They are not reentrant,
  // and only one thread may call them at a time. If a task throws, they rethrow the first exception.

  /// Calls use(thread, item) once for each item below `count`, in any order: on the caller's thread, and on those
  /// others that wake up before it is done. It waits for no thread that has not woken up, and leaves the others alone
  /// for a while after they took long. `use` must not call barrier(). After an exception some items may be left out.
  void share(int threads, std::size_t count, const std::function<void(int thread, std::size_t item)>& use);

  /// Calls task(part) once for each part below `parts`, as share() does on as many threads.
  void run(int parts, const std::function<void(int part)>& task);

  /// Calls task(thread) once on each of these threads, all at the same time. Returns when all tasks have returned. If a
  /// task throws, the other tasks run on until their next barrier(), which then throws too: do not catch that
  /// exception.
  void run_together(int threads, const std::function<void(int thread)>& task);

  /// Waits until every thread of the current run_together() has called it. Only for use inside its task, by all
  /// threads.
  void barrier();

 private:
  struct Shared;
  int threads_, useful_threads_;  // the latter: what threads_for() returns at most
  double least_share_;
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
