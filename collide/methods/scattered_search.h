#pragma once
// Tests one run of slots against many short runs, many of them at a time. Memory: 256 runs a thread.

#include "collide/core/contact_search.h"

namespace collide::methods {

class ScatteredSearch {
 public:
  /// Starts a frame. `search` must stay alive until the frame ends.
  void begin(ContactSearch& search, int threads) {
    search_ = &search;
    threads_.resize(static_cast<std::size_t>(threads));
  }

  // For each run of rows, on one thread: call start(), then add() for each run that the rows meet, then finish(). Then
  // every pair of runs has been tested as by ContactSearch::test(thread, rows, run).
  void start(int thread, Range rows, bool rows_meet_themselves) {
    threads_[static_cast<std::size_t>(thread)].rows = rows;
    if (rows_meet_themselves) search_->test(thread, rows, rows);
  }
  /// run: begins where the rows end, or later.
  void add(int thread, Range run) {
    Thread& own = threads_[static_cast<std::size_t>(thread)];
    if (own.rows.size() > short_run || run.size() > short_run) {
      search_->test(thread, own.rows, run);
    } else {
      if (own.runs.size() == max_runs) finish(thread);
      own.runs.push_back(run);
    }
  }
  void finish(int thread) {
    Thread& own = threads_[static_cast<std::size_t>(thread)];
    search_->test(thread, own.rows, own.runs);
    own.runs.clear();
  }

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
