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
class BatchShares;

/// What one of the threads at work integrates: some batches in step with the other threads, or one batch that no
/// contact joins to others, by itself.
struct BatchShare {
  const BatchShares& all;
  int thread;                             // its number, from 0 to one below all.active()
  std::span<const Batch* const> batches;  // that move; no other thread writes to them
  bool is_alone = false;                  // with one batch: shares no items, and waits for nobody

  /// Returns the same thread with only this batch.
  BatchShare alone_with(const Batch* const& batch) const { return {all, thread, std::span(&batch, 1), true}; }
  /// Returns this thread's part of `count` items, which all threads at work share.
  collide::Part part(std::size_t count) const;
  /// Waits until all threads at work have called it.
  void barrier() const;
};

/// Shares what moves in a frame among the threads.
class BatchShares {
 public:
  explicit BatchShares(collide::Workers& workers) : workers_(workers) {}

  /// Takes the batches that move in the coming frame, and how many particles they have in all. They must not be moved
  /// in memory as long as anybody asks for them. Until deal() is called, all are joined, and cost the same.
  void take(std::vector<const Batch*> moving, std::size_t particles);
  /// Takes what each batch that contacts join to others costs in a substep, and 0 for those that are alone.
  void deal(const std::function<std::size_t(const Batch&)>& cost);
  /// Returns the batches that move in the frame at hand.
  const std::vector<const Batch*>& moving() const { return moving_; }
  /// Returns how many threads are at work on them.
  int active() const { return active_; }
  /// Returns the joined batches that a thread at work integrates. Thread 0 is always at work.
  BatchShare share(int thread) const;
  /// Returns those that are alone, for whichever thread has time.
  const std::vector<const Batch*>& alone() const { return alone_; }
  /// Returns all threads that there are.
  collide::Workers& workers() const { return workers_; }
  /// Calls use(i) for each i below `count`, in any order, on those threads at work that come in time. `use` must not
  /// wait at a barrier.
  void for_each(std::size_t count, const std::function<void(std::size_t)>& use) const;
  /// Calls the task once on each thread at work. Returns when all calls have returned. Rethrows what one has thrown.
  void run(const std::function<void(const BatchShare&)>& task) const;

 private:
  collide::Workers& workers_;
  std::vector<const Batch*> moving_, joined_, alone_;
  std::vector<std::size_t> middle_;  // of each joined batch's part of the costs of all, one after another
  std::size_t total_cost_ = 0;
  int active_ = 1;
};

}  // namespace softbody
