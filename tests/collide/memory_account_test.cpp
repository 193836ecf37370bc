// When remembering contacts is taken up, given up and taken up again.

#include "collide/memory_account.h"

#include <gtest/gtest.h>

namespace collide::test {
namespace {

constexpr std::size_t vertices = 1000, contacts = 100;
constexpr std::uint64_t tests = 5000;

MemoryAccount opened() {
  MemoryAccount account;
  account.open(vertices, contacts, tests);
  return account;
}

int frames_of_pause(MemoryAccount& account) {
  int frames = 0;
  while (account.take_pause()) ++frames;
  return frames;
}

TEST(MemoryAccount, HasNothingBeforeItIsOpened) {
  const MemoryAccount account;
  EXPECT_TRUE(account.spent());
  EXPECT_EQ(account.most_candidates(), 0u);
}

TEST(MemoryAccount, OpensOnCreditForAFewSearches) {
  MemoryAccount account = opened();
  int searches = 0;
  for (; !account.spent(); ++searches) account.pay_for_all(0);
  EXPECT_EQ(searches, 16);
}

TEST(MemoryAccount, AllThatThereIsCreditForSpendsIt) {
  MemoryAccount account = opened();
  const std::size_t most = account.most_candidates();
  account.pay_for_some(0, most - 1, 0);
  EXPECT_FALSE(account.spent());
  account.pay_for_some(0, 2, 0);
  EXPECT_TRUE(account.spent());
}

TEST(MemoryAccount, EarnsWithFewCandidatesAndLosesWithMany) {
  MemoryAccount account = opened();
  account.pay_for_all(0);
  const std::size_t before = account.most_candidates();
  account.earn(vertices, 10);
  const std::size_t after = account.most_candidates();
  EXPECT_GT(after, before);
  account.earn(vertices, 100'000);
  EXPECT_LT(account.most_candidates(), before);
}

TEST(MemoryAccount, PutsByNoMoreThanItOpenedWith) {
  MemoryAccount account = opened();
  const std::size_t most = account.most_candidates();
  for (int i = 0; i < 1000; ++i) account.earn(vertices, 0);
  EXPECT_EQ(account.most_candidates(), most);
}

TEST(MemoryAccount, PausesTwiceAsLongEachTimeItIsSpent) {
  MemoryAccount account;
  for (const int frames : {8, 16, 32, 64, 128, 256, 256}) {
    account.open(vertices, contacts, tests);
    account.spend_all();
    account.pause();
    EXPECT_EQ(frames_of_pause(account), frames);
  }
}

TEST(MemoryAccount, PausesBrieflyAgainOnceItHasPaid) {
  MemoryAccount account;
  for (int i = 0; i < 3; ++i) {
    account.open(vertices, contacts, tests);
    account.spend_all();
    account.pause();
  }
  frames_of_pause(account);
  account.open(vertices, contacts, tests);
  account.earn(vertices, 0);  // what is put by is full
  account.spend_all();
  account.pause();
  EXPECT_EQ(frames_of_pause(account), 8);
}

TEST(MemoryAccount, PausesBrieflyWhereNothingIsOwed) {
  MemoryAccount account;
  for (int i = 0; i < 3; ++i) {
    account.open(vertices, contacts, tests);
    account.pause();
    EXPECT_EQ(frames_of_pause(account), 8);
  }
}

}  // namespace
}  // namespace collide::test
