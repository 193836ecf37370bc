#include "collide/methods/scattered_search.h"

namespace collide::methods {

void ScatteredSearch::begin(ContactSearch& search, int threads) {
  search_ = &search;
  threads_.resize(static_cast<std::size_t>(threads));
}

void ScatteredSearch::start(int thread, Range rows, bool rows_meet_themselves) {
  threads_[static_cast<std::size_t>(thread)].rows = rows;
  if (rows_meet_themselves) search_->test(thread, rows, rows);
}

void ScatteredSearch::finish(int thread) {
  Thread& own = threads_[static_cast<std::size_t>(thread)];
  search_->test(thread, own.rows, own.runs);
  own.runs.clear();
}

}  // namespace collide::methods
