#pragma once
// One run of slots against many short runs, which are tested together. Memory: 256 runs a thread.

#include "collide/core/contact_search.h"

namespace collide::methods {

class ScatteredSearch {
 public:
  /// search must stay alive.
  void begin(ContactSearch& search, int threads);

  // For each run of rows on a thread: start(), add() what it meets, finish(). In the end all have been tested as
  // ContactSearch::test(thread, rows, run) does it.
  void start(int thread, Range rows, bool rows_meet_themselves);
  /// The run begins where rows ends or later.
  void add(int thread, Range run) {
    Thread& own = threads_[static_cast<std::size_t>(thread)];
    if (own.rows.size() > short_run || run.size() > short_run) {
      search_->test(thread, own.rows, run);
    } else {
      if (own.runs.size() == max_runs) finish(thread);
      own.runs.push_back(run);
    }
  }
  void finish(int thread);

 private:
  static constexpr Index short_run = 64, max_runs = 256;  // 2^20 pairs
  struct alignas(64) Thread {
    Range rows;
    std::vector<Range> runs;
  };

  ContactSearch* search_ = nullptr;
  std::vector<Thread> threads_;
};

}  // namespace collide::methods
