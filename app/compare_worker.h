#pragma once
// The comparison's own thread: the demo hands it copies and never waits for it.

#include <condition_variable>
#include <mutex>
#include <thread>

#include "app/compare.h"

namespace app {

class CompareWorker {
 public:
  CompareWorker();

  /// True if an offer would be taken now. After a comparison the worker rests for twice its duration, so that it never
  /// takes more than a third of a core from the simulation and the drawing.
  bool ready() const;
  /// Takes the snapshot, or drops it if not ready(). Never waits for a comparison.
  void offer(Snapshot snapshot);
  /// The latest report that was not yet taken.
  std::optional<CompareReport> take();

 private:
  void work(const std::stop_token& stop);

  mutable std::mutex mutex_;  // guards the members below
  std::condition_variable_any wake_;
  std::optional<Snapshot> waiting_;
  std::optional<CompareReport> done_;
  bool busy_ = false;
  double rest_until_ = 0;  // s, steady clock
  std::jthread thread_;    // last: started after, joined before all else
};

}  // namespace app
