#include "collide/core/index_set.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace collide::test {
namespace THIS_FILE {

/// Runs of random sets, some dense and some sparse, against std::set. One IndexSet serves all, so it must empty itself.
TEST(IndexSet, HandsOutItsLongestRunsInOrderAndIsEmptyThen) {
  constexpr Index count = 20'000;  // more than one word of used words
  IndexSet set;
  set.reset(count);
  std::mt19937 random(31);
  for (int trial = 0; trial < 200; ++trial) {
    const Index least = random() % count;
    std::set<Index> expected;
    for (std::uint32_t adds = random() % 100; adds > 0; --adds) {
      const Index word = random() % (count / IndexSet::word_size);
      const IndexSet::Word bits = trial % 3 == 0 ? ~IndexSet::Word{0} : IndexSet::Word{1} << random() % 64;
      if (word * IndexSet::word_size < least) continue;
      set.add(word, bits);
      for (Index k = 0; k < IndexSet::word_size; ++k) {
        if (bits >> k & 1) expected.insert(word * IndexSet::word_size + k);
      }
    }
    std::set<Index> found;
    Index end = 0;
    set.take_runs(least, [&](Range run) {
      ASSERT_LT(run.begin, run.end);
      ASSERT_TRUE(found.empty() || run.begin > end) << "two runs that are one, or out of order";
      end = run.end;
      for (Index k = run.begin; k < run.end; ++k) found.insert(k);
    });
    ASSERT_EQ(found, expected);
    set.take_runs(0, [](Range) { FAIL() << "not emptied"; });
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
