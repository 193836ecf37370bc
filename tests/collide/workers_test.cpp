#include "collide/core/workers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace collide::test {
namespace THIS_FILE {

TEST(Workers, NeedAThread) { EXPECT_THROW(Workers(0), std::invalid_argument); }

TEST(Workers, SeeEachOthersDataBehindABarrier) {
  Workers workers(3);
  std::array<int, 3> written{}, sums{};
  workers.run_together(workers.threads(), [&](int thread) {
    const auto own = static_cast<std::size_t>(thread);
    for (int round = 1; round <= 100; ++round) {
      written[own] = round * (thread + 1);
      workers.barrier();
      sums[own] = written[0] + written[1] + written[2];
      workers.barrier();
    }
  });
  EXPECT_EQ(sums, (std::array<int, 3>{600, 600, 600}));
}

TEST(Workers, RethrowAndCanBeUsedAgain) {
  Workers workers(3);
  for (int culprit = 0; culprit < 3; ++culprit) {
    std::atomic<int> others = 0;
    EXPECT_THROW(workers.run_together(workers.threads(),
                                      [&](int thread) {
                                        if (thread == culprit) throw std::length_error("too much");
                                        ++others;
                                      }),
                 std::length_error);
    EXPECT_EQ(others, 2);
  }
  std::atomic<int> calls = 0;
  workers.run_together(workers.threads(), [&](int) { ++calls; });
  EXPECT_EQ(calls, 3);
}

TEST(Workers, ShareItemsEachDoneOnce) {
  for (const int threads : {1, 2, 3, 8}) {
    Workers workers(threads);
    for (std::size_t count = 0; count < 300; ++count) {
      std::vector<std::atomic<int>> done(count);
      std::vector<int> own(static_cast<std::size_t>(threads), 0);  // no two threads have one number
      const int asked_for = 1 + static_cast<int>(count) % threads;
      workers.share(asked_for, count, [&](int thread, std::size_t item) {
        ++done[item];
        ++own[static_cast<std::size_t>(thread)];
      });
      for (const std::atomic<int>& times : done) ASSERT_EQ(times, 1);
      ASSERT_EQ(std::accumulate(own.begin(), own.begin() + asked_for, 0), static_cast<int>(count));
      if (count % 7 == 0) {  // those that came too late take part in what all do
        std::atomic<int> calls = 0;
        workers.run_together(workers.threads(), [&](int) { ++calls; });
        ASSERT_EQ(calls, threads);
      }
    }
  }
}

TEST(Workers, ShareRethrows) {
  Workers workers(3);
  for (std::size_t bad = 0; bad < 50; ++bad) {
    const auto fail = [&](int, std::size_t item) {
      if (item == bad) throw std::length_error("too much");
    };
    EXPECT_THROW(workers.share(3, 50, fail), std::length_error);
    EXPECT_NO_THROW(workers.share(3, bad, fail));
  }
}

TEST(Workers, DoNotWaitAtABarrierForOneThatHasThrown) {
  Workers workers(3);
  for (int repeat = 0; repeat < 100; ++repeat) {
    std::atomic<int> got_past = 0;
    EXPECT_THROW(workers.run_together(workers.threads(),
                                      [&](int thread) {
                                        workers.barrier();
                                        if (thread == repeat % 3) throw std::runtime_error("failed");
                                        workers.barrier();
                                        ++got_past;
                                        workers.barrier();
                                      }),
                 std::runtime_error);
    EXPECT_EQ(got_past, 0);
    workers.run_together(workers.threads(), [&](int) { workers.barrier(); });
  }
}

TEST(Workers, GiveEachThreadItsLeastShareAndAProcessor) {
  Workers workers(2);
  const int both = std::thread::hardware_concurrency() == 1 ? 1 : 2;
  EXPECT_EQ(workers.threads_for(0), 1);
  EXPECT_EQ(workers.threads_for(1.9 * Workers::least_share), 1);
  EXPECT_EQ(workers.threads_for(2 * Workers::least_share), both);
  EXPECT_EQ(workers.threads_for(1e300), both);
  EXPECT_EQ(Workers(4, 0).threads_for(0), 4);
  EXPECT_LE(Workers(256).threads_for(1e300), static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
}

TEST(Workers, RunTogetherOnAsManyThreadsAsAskedFor) {
  Workers workers(4);
  for (int repeat = 0; repeat < 300; ++repeat) {
    const int threads = 1 + repeat * 7 % 4;
    std::vector<std::thread::id> together(4);
    workers.run_together(threads, [&](int thread) {
      together[static_cast<std::size_t>(thread)] = std::this_thread::get_id();
      workers.barrier();
    });
    ASSERT_EQ(together[0], std::this_thread::get_id()) << "the caller is thread 0";
    ASSERT_EQ(std::set(together.begin(), together.end()).size(), std::min(4u, 1u + static_cast<unsigned>(threads)));
  }
}

TEST(PartOf, CutsInOrderAndEvenly) {
  for (const std::size_t count : {0u, 1u, 7u, 100u}) {
    std::size_t next = 0;
    for (int thread = 0; thread < 3; ++thread) {
      const Part part = part_of(count, thread, 3);
      EXPECT_EQ(part.begin, next);
      EXPECT_LE(part.end - part.begin, count / 3 + 1);
      next = part.end;
    }
    EXPECT_EQ(next, count);
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
