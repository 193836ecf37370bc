#include "softbody/integrate/batch_shares.h"

#include <gtest/gtest.h>

#include <atomic>

#include "softbody/state/state.h"

namespace softbody::test {
namespace THIS_FILE {

class BatchSharesTest : public testing::Test {
 protected:
  /// `count` of the batches move, of 100 particles in all.
  void take(std::size_t count) {
    std::vector<const Batch*> moving;
    for (std::size_t i = 0; i < count; ++i) moving.push_back(&batches_[i]);
    shares.take(std::move(moving), 100);
  }

  collide::Workers workers{3, 0};
  BatchShares shares{workers};

 private:
  std::array<Batch, 8> batches_;
};

TEST_F(BatchSharesTest, SharesBatchesInTheirOrder) {
  for (const std::size_t count : {0, 1, 2, 3, 8}) {
    take(count);
    ASSERT_EQ(shares.active(), 3);
    std::vector<const Batch*> dealt;
    for (int i = 0; i < shares.active(); ++i)
      for (const Batch* b : shares.share(i).batches) dealt.push_back(b);
    EXPECT_EQ(dealt, shares.moving());
  }
}

TEST_F(BatchSharesTest, SharesJoinedBatchesByWhatTheyCostAndLeavesTheOthersAlone) {
  take(8);
  const auto first = shares.moving()[0];
  shares.deal([&](const Batch& b) { return std::array{60, 0, 40, 0, 100, 0, 50, 50}[std::size_t(&b - first)]; });
  std::vector<std::vector<std::ptrdiff_t>> joined(3);
  for (int i = 0; i < 3; ++i)
    for (const Batch* b : shares.share(i).batches) joined[std::size_t(i)].push_back(b - first);
  EXPECT_EQ(joined, (std::vector<std::vector<std::ptrdiff_t>>{{0, 2}, {4}, {6, 7}}));
  ASSERT_EQ(shares.alone().size(), 3u);
  const BatchShare alone = shares.share(1).alone_with(shares.alone()[1]);
  EXPECT_EQ(alone.batches[0] - first, 3);
  EXPECT_EQ(alone.thread, 1);
  EXPECT_EQ(alone.part(100).end, 0u) << "the others share these";
  alone.barrier();  // nobody else is to come
}

TEST_F(BatchSharesTest, LeavesFewParticlesToOneThread) {
  take(8);
  collide::Workers all(3);
  BatchShares few(all);
  few.take(shares.moving(), 100);
  EXPECT_EQ(few.active(), 1);
  int calls = 0;
  few.run([&](const BatchShare& share) {
    ++calls;
    share.barrier();  // nobody else is to come
    EXPECT_EQ(share.thread, 0);
    EXPECT_EQ(share.batches.size(), 8u);
  });
  EXPECT_EQ(calls, 1);
}

TEST_F(BatchSharesTest, MeetsAtTheBarrier) {
  take(8);
  std::atomic<int> came = 0;
  std::array<int, 3> seen{};
  shares.run([&](const BatchShare& share) {
    ++came;
    share.barrier();
    seen[std::size_t(share.thread)] = came;
  });
  EXPECT_EQ(seen, (std::array{3, 3, 3}));
}

}  // namespace THIS_FILE
}  // namespace softbody::test
