#pragma once
// A thread that answers questions about copies of the world, one at a time. The demo hands a question over and never
// waits for the answer.

#include <cassert>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace app {

/// Task: has the types Question and Answer, and a member
///   Answer answer(const Question& question, const std::stop_token& stop)
/// that throws nothing. The thread makes one Task, which may keep data from one question to the next.
template <class Task>
class BackgroundWorker {
 public:
  using Question = typename Task::Question;
  using Answer = typename Task::Answer;

  BackgroundWorker() : thread_([this](const std::stop_token& stop) { work(stop); }) {}

  /// Returns true if offer() would take a question now and the worker has rested. rests: the rest after an answer, in
  /// multiples of the time that the answer took. With 2 the worker takes at most a third of a core from the simulation
  /// and the drawing.
  bool ready(int rests = 2) const {
    assert(rests >= 0);
    const std::scoped_lock lock(mutex_);
    return !busy_ && !waiting_ && Clock::now() >= answered_ + rests * took_;
  }

  /// Returns true if a question waits, is being answered, or was answered and take() has not been called since.
  bool has_work() const {
    const std::scoped_lock lock(mutex_);
    return busy_ || waiting_ || done_;
  }

  /// Takes the question; drops it if another one waits or is being answered. Does not wait for an answer.
  void offer(Question question) {
    {
      const std::scoped_lock lock(mutex_);
      if (busy_ || waiting_) return;
      waiting_ = std::move(question);
    }
    wake_.notify_one();
  }

  /// Returns the latest answer, once; nothing if there is no new one.
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
  std::jthread thread_;  // last member: starts after the others are made, and ends before they go
};

}  // namespace app
