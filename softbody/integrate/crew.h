#pragma once
// The threads that take the substeps of a frame, and which of them does what.

#include <cassert>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "collide/core/workers.h"

namespace softbody {

struct Batch;
class Crew;

/// One of the threads at work, as it sees itself.
class Worker {
 public:
  /// `index`: of the thread, from 0 to one below crew.active().
  Worker(const Crew& crew, int index);

  /// Returns the number of this thread. Thread 0 is always at work.
  int index() const { return index_; }
  /// Returns the moving batches that this thread integrates. No other thread writes to them.
  std::span<const Batch* const> batches() const;
  /// Returns this thread's part of `count` items, which all threads at work share.
  collide::Part part(std::size_t count) const;
  /// Waits until all threads at work have called it.
  void barrier() const;

 private:
  const Crew& crew_;
  int index_;
};

/// Shares what moves in a frame among the threads. Who integrates what depends only on the number of threads.
class Crew {
 public:
  /// Fewer particles than `min_shared` are left to one thread: to share them would take longer.
  Crew(collide::Workers& workers, std::size_t min_shared) : workers_(workers), min_shared_(min_shared) {}

  /// Takes the batches that move in the coming frame, and how many particles they have in all. They must not be moved
  /// in memory as long as anybody asks for them.
  void take(std::vector<const Batch*> moving, std::size_t particles);
  /// Returns the batches that move in the frame at hand.
  const std::vector<const Batch*>& moving() const { return moving_; }
  /// Returns how many threads are at work on them.
  int active() const { return active_; }
  /// Returns all threads that there are.
  collide::Workers& workers() const { return workers_; }
  /// Calls the task once on each thread at work. Returns when all calls have returned. Rethrows what one has thrown.
  void run(const std::function<void(const Worker&)>& task) const;

 private:
  collide::Workers& workers_;
  std::size_t min_shared_;
  std::vector<const Batch*> moving_;
  int active_ = 1;
};

}  // namespace softbody
