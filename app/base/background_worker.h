#pragma once
// A thread that answers questions about copies of the world, one at a time: the demo hands them over and never waits.

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace app {

/// Task: has the types Question and Answer, and a member
///   Answer answer(const Question& question, const std::stop_token& stop)
/// that throws nothing. It is made on the thread and may remember what it needs from one question to the next.
template <class Task>
class BackgroundWorker {
 public:
  using Question = typename Task::Question;
  using Answer = typename Task::Answer;

  BackgroundWorker() : thread_([this](const std::stop_token& stop) { work(stop); }) {}

  /// True if an offer would be taken now. After an answer the worker rests for so many times as long as that took: with
  /// 2 it never takes more than a third of a core from the simulation and the drawing.
  bool ready(int rests = 2) const {
    const std::scoped_lock lock(mutex_);
    return !busy_ && !waiting_ && Clock::now() >= answered_ + rests * took_;
  }

  /// Takes the question, or drops it if another one is waiting or being answered. Never waits for an answer.
  void offer(Question question) {
    {
      const std::scoped_lock lock(mutex_);
      if (busy_ || waiting_) return;
      waiting_ = std::move(question);
    }
    wake_.notify_one();
  }

  /// The latest answer that was not yet taken.
  std::optional<Answer> take() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(done_, std::nullopt);
  }

 private:
  using Clock = std::chrono::steady_clock;

  void work(const std::stop_token& stop) {
    Task task;
    std::unique_lock lock(mutex_);
    while (wake_.wait(lock, stop, [this] { return waiting_.has_value(); })) {
      const Question question = std::move(*waiting_);
      waiting_.reset();
      busy_ = true;
      lock.unlock();
      const Clock::time_point start = Clock::now();
      Answer answer = task.answer(question, stop);
      const Clock::time_point end = Clock::now();
      lock.lock();
      done_ = std::move(answer);
      busy_ = false;
      answered_ = end;
      took_ = end - start;
    }
  }

  mutable std::mutex mutex_;  // guards the members below
  std::condition_variable_any wake_;
  std::optional<Question> waiting_;
  std::optional<Answer> done_;
  bool busy_ = false;
  Clock::time_point answered_;
  Clock::duration took_{};
  std::jthread thread_;  // last: started after, joined before all else
};

}  // namespace app
