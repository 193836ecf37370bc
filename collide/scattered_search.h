#pragma once
// One run of slots against many short runs. To test a handful of vertices costs little more than one vertex, so short
// runs are first copied side by side and then tested as a single one. Memory: 1024 vertices
// and runs a thread.

#include "collide/contact_search.h"

namespace collide {

class ScatteredSearch {
 public:
  /// search and points, those that the search has begun with, must stay alive and unchanged.
  void begin(ContactSearch& search, const Points& points, int threads);

  // For each run of rows on a thread: start(), add() what it meets, finish(). In the end all have been tested as
  // ContactSearch::test(thread, rows, run) does it.
  void start(int thread, Range rows, bool rows_meet_themselves);
  /// The run begins where rows ends or later.
  void add(int thread, Range run) {
    Thread& own = threads_[static_cast<std::size_t>(thread)];
    if (own.rows.size() > short_run || run.size() > short_run) {
      search_->test(thread, own.rows, run);
    } else {
      if (own.copies.size() + run.size() > most_copies) test_copies(own, thread);
      own.append(*points_, run);
    }
  }
  void finish(int thread) { test_copies(threads_[static_cast<std::size_t>(thread)], thread); }

 private:
  static constexpr Index short_run = 64, most_copies = 1024;
  struct alignas(64) Thread {
    Range rows;
    Places copies;                  // of the rows, then of runs
    Index tested;                   // the copies before this one need not be tested any more
    std::vector<SlotPair> origins;  // of each run: its first copy, and the slot that it is of; the rows are the first

    void append(const Points& from, Range run) {
      origins.push_back({copies.size(), run.begin});
      copies.append(from, run);
    }
    Index slot_of(Index copy) const;
  };
  void test_copies(Thread& own, int thread);

  ContactSearch* search_ = nullptr;
  const Points* points_ = nullptr;
  std::vector<Thread> threads_;
};

}  // namespace collide
