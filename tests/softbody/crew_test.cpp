#include "softbody/integrate/crew.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

#include "softbody/state/state.h"

namespace softbody::test {
namespace {

class CrewOfThree : public testing::Test {
 protected:
  /// `count` of the batches move, of 100 particles in all.
  void take(std::size_t count) {
    std::vector<const Batch*> moving;
    for (std::size_t i = 0; i < count; ++i) moving.push_back(&batches_[i]);
    crew.take(std::move(moving), 100);
  }

  collide::Workers workers{3, 0};
  Crew crew{workers};

 private:
  std::array<Batch, 8> batches_;
};

TEST_F(CrewOfThree, SharesBatchesInTheirOrder) {
  for (const std::size_t count : {0, 1, 2, 3, 8}) {
    take(count);
    ASSERT_EQ(crew.active(), 3);
    std::vector<const Batch*> shared;
    for (int i = 0; i < crew.active(); ++i)
      for (const Batch* b : Worker(crew, i).batches()) shared.push_back(b);
    EXPECT_EQ(shared, crew.moving());
  }
}

TEST_F(CrewOfThree, SharesJoinedBatchesByWhatTheyCostAndLeavesTheOthersAlone) {
  take(8);
  const auto first = crew.moving()[0];
  crew.share([&](const Batch& b) { return std::array{60, 0, 40, 0, 100, 0, 50, 50}[std::size_t(&b - first)]; });
  std::vector<std::vector<std::ptrdiff_t>> joined(3);
  for (int i = 0; i < 3; ++i)
    for (const Batch* b : Worker(crew, i).batches()) joined[std::size_t(i)].push_back(b - first);
  EXPECT_EQ(joined, (std::vector<std::vector<std::ptrdiff_t>>{{0, 2}, {4}, {6, 7}}));
  ASSERT_EQ(crew.alone().size(), 3u);
  const Worker alone = Worker(crew, 1).alone_with(crew.alone()[1]);
  EXPECT_EQ(alone.batches()[0] - first, 3);
  EXPECT_EQ(alone.index(), 1);
  EXPECT_EQ(alone.part(100).end, 0u) << "the others share these";
  alone.barrier();  // nobody else is to come
}

TEST_F(CrewOfThree, VisitsEachIndexOnce) {
  take(8);
  std::array<std::atomic<int>, 50> visits{};
  crew.for_each(visits.size(), [&](std::size_t i) { ++visits[i]; });
  for (const std::atomic<int>& v : visits) EXPECT_EQ(v, 1);
}

TEST_F(CrewOfThree, SharesItems) {
  take(1);
  std::size_t next = 0;
  for (int i = 0; i < crew.active(); ++i) {
    const collide::Part part = Worker(crew, i).part(100);
    EXPECT_EQ(part.begin, next);
    next = part.end;
  }
  EXPECT_EQ(next, 100u);
}

TEST_F(CrewOfThree, LeavesFewParticlesToOneThread) {
  take(8);
  collide::Workers all(3);
  Crew few(all);
  few.take(crew.moving(), 100);
  EXPECT_EQ(few.active(), 1);
  int calls = 0;
  few.run([&](const Worker& worker) {
    ++calls;
    worker.barrier();  // nobody else is to come
    EXPECT_EQ(worker.index(), 0);
    EXPECT_EQ(worker.batches().size(), 8u);
  });
  EXPECT_EQ(calls, 1);
}

TEST_F(CrewOfThree, MeetsAtTheBarrier) {
  take(8);
  std::atomic<int> came = 0;
  std::array<int, 3> seen{};
  crew.run([&](const Worker& worker) {
    ++came;
    worker.barrier();
    seen[std::size_t(worker.index())] = came;
  });
  EXPECT_EQ(seen, (std::array{3, 3, 3}));
}

TEST_F(CrewOfThree, ThrowsWhatOneThrows) {
  take(8);
  const auto task = [](const Worker& worker) {
    if (worker.index() == 1) throw std::runtime_error("one");
    worker.barrier();
  };
  EXPECT_THROW(crew.run(task), std::runtime_error);
}

}  // namespace
}  // namespace softbody::test
