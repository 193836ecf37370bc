#include "collide/scattered_search.h"

namespace collide {

void ScatteredSearch::begin(ContactSearch& search, const Points& points, int threads) {
  search_ = &search;
  points_ = &points;
  threads_.resize(static_cast<std::size_t>(threads));
  for (Thread& own : threads_) own.copies.resize(most_copies);
}

void ScatteredSearch::start(int thread, Range rows, bool rows_meet_themselves) {
  Thread& own = threads_[static_cast<std::size_t>(thread)];
  own.rows = rows;
  own.copies.shrink(0);
  own.tested = 0;
  if (rows.size() > short_run) {
    if (rows_meet_themselves) search_->test(thread, rows, rows);
  } else {
    own.copies.append(*points_, rows);
    if (!rows_meet_themselves) own.tested = rows.size();
  }
}

void ScatteredSearch::test_copies(Thread& own, int thread) {
  if (own.tested == own.copies.size()) return;
  const Index rows = own.rows.size();
  search_->test(thread, own.copies, {0, rows}, {own.tested, own.copies.size()});
  own.tested = rows;
  own.copies.shrink(rows);
}

}  // namespace collide
