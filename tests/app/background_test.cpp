#include "app/base/background.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <stdexcept>
#include <vector>

namespace app {
namespace THIS_FILE {

/// Counts up to the number of the question, one a part, and shows each count. Ends where it is cancelled.
struct Count {
  using Question = int;
  struct Answer {
    int question = 0, count = 0;
    bool whole = false;
  };
  explicit Count(int first) : from(first) {}
  std::optional<Answer> advance(int question, Background<Count>& background) {
    if (background.cancelled() || count == question) return Answer{question, std::exchange(count, from), true};
    ++count;
    background.publish({question, count, false});
    return std::nullopt;
  }
  int from, count = from;
};

struct Echo;
/// Asks a Background something, where it is freed.
struct Ask {
  void operator()(Background<Echo>* background) const;
};
/// Publishes and answers what asks when it is freed, as the question does.
struct Echo {
  using Question = std::unique_ptr<Background<Echo>, Ask>;
  using Answer = Question;
  std::optional<Answer> advance(const Question& question, Background<Echo>& background) {
    background.publish(Answer(question.get()));
    return Answer(question.get());
  }
};
void Ask::operator()(Background<Echo>* background) const { background->has_work(); }

class BackgroundTest : public testing::TestWithParam<Runs> {
 protected:
  /// Takes until there is an answer that `is_last`; returns all.
  std::vector<Count::Answer> take_until(auto is_last) {
    std::vector<Count::Answer> answers;
    while (answers.empty() || !is_last(answers.back()))
      if (const auto answer = count.take(Background<Count>::Clock::duration::zero())) answers.push_back(*answer);
    return answers;
  }

  Background<Count> count{GetParam(), 0};
};
INSTANTIATE_TEST_SUITE_P(Runs, BackgroundTest, testing::Values(Runs::on_thread, Runs::in_slices));

TEST_P(BackgroundTest, AnswersEachQuestionOnceAndInTheirOrder) {
  EXPECT_TRUE(count.ready(0));
  EXPECT_FALSE(count.has_work());
  EXPECT_FALSE(count.wait()) << "there is no question";
  for (int i = 0; i < 3; ++i) {
    count.offer(i);
    EXPECT_TRUE(count.has_work());
    const auto answer = count.wait();
    ASSERT_TRUE(answer);
    EXPECT_TRUE(answer->whole);
    EXPECT_EQ(answer->question, i);
    EXPECT_EQ(answer->count, i);
    EXPECT_FALSE(count.take());
    EXPECT_FALSE(count.has_work());
    EXPECT_TRUE(count.ready(0));
  }
  for (const int question : {5, 3, 4}) count.offer(question);
  EXPECT_EQ(count.wait()->question, 4) << "the last of those that waited";
  EXPECT_EQ(count.waiting(), 0u);
}

TEST_P(BackgroundTest, ShowsHowFarATaskHasGot) {
  count.offer(1000);
  const auto answers = take_until([](const Count::Answer& answer) { return answer.whole; });
  EXPECT_EQ(answers.back().count, 1000);
  for (std::size_t i = 1; i < answers.size(); ++i) EXPECT_GE(answers[i].count, answers[i - 1].count);
  EXPECT_TRUE(count.was_taken());
  EXPECT_TRUE(count.ready(0)) << "at once";
}

TEST_P(BackgroundTest, CancelsTheQuestionsOfferedSoFar) {
  constexpr int without_end = -1;
  for (int i = 0; i < 3; ++i) {
    count.offer(without_end);
    take_until([](const Count::Answer& answer) { return answer.count > 10; });
    EXPECT_FALSE(count.cancelled());
    EXPECT_FALSE(count.ready(0));
    count.offer(without_end);
    EXPECT_EQ(count.waiting(), 1u);
    count.cancel();
    EXPECT_TRUE(count.cancelled());
    const auto answer = count.wait();
    ASSERT_TRUE(answer);
    EXPECT_TRUE(answer->whole);
    EXPECT_EQ(answer->count, 0) << "the second one was not begun";
    EXPECT_TRUE(count.cancelled());
  }
  count.offer(2);
  EXPECT_EQ(count.wait()->count, 2) << "later questions are not cancelled";
}

TEST_P(BackgroundTest, CanBeDestroyedWhileItWorks) {
  constexpr int without_end = -1;
  for (const int counts : {0, 10}) {
    Background<Count> other(GetParam(), 0);
    for (int i = 0; i < 2; ++i) other.offer(without_end);
    for (int seen = 0; seen < counts;)
      if (const auto answer = other.take()) seen = answer->count;
  }
}

TEST_P(BackgroundTest, FreesQuestionsAndAnswersWhereOthersDoNotWaitForIt) {
  Background<Echo> echo(GetParam());
  for (int i = 0; i < 3; ++i) echo.offer(Echo::Question(&echo));
  EXPECT_EQ(echo.wait()->get(), &echo);
}

TEST_P(BackgroundTest, CallsAFunctionBesideTheWindow) {
  int called = 0;
  std::atomic<int> meanwhile = 0;
  const bool has_thread = GetParam() == Runs::on_thread;
  const auto call = [&] {
    while (has_thread && meanwhile == 0) continue;
    if (++called == 2) throw std::runtime_error("the second call");
  };
  const auto count_meanwhile = [&] { ++meanwhile; };
  call_beside(call, {}, count_meanwhile, GetParam());
  EXPECT_EQ(called, 1);
  EXPECT_EQ(meanwhile > 0, has_thread);
  EXPECT_THROW(call_beside(call, {}, count_meanwhile, GetParam()), std::runtime_error);
}

TEST(Background, DoesOnePartInAnEmptySliceAndAllInALongOne) {
  Background<Count> count(Runs::in_slices, 0);
  count.offer(2);
  for (int i = 1; i <= 2; ++i) {
    const auto so_far = count.take({});
    ASSERT_TRUE(so_far);
    EXPECT_FALSE(so_far->whole);
    EXPECT_EQ(so_far->count, i);
    EXPECT_FALSE(count.ready(0));
  }
  const auto answer = count.take({});
  ASSERT_TRUE(answer);
  EXPECT_TRUE(answer->whole);
  EXPECT_FALSE(count.take({}));
  for (const int question : {5, 3}) count.offer(question);
  EXPECT_EQ(count.take(Background<Count>::Clock::duration::max() / 4)->question, 3) << "all parts in a long slice";
}

}  // namespace THIS_FILE
}  // namespace app
