#pragma once
// Work beside the window: on a thread of its own, or in slices between two pictures where there are no threads, as in a
// browser.

#include <algorithm>
#include <cassert>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace app {

enum class Runs { on_thread, in_slices };
#ifdef __EMSCRIPTEN__
inline constexpr Runs usual_runs = Runs::in_slices;
#else
inline constexpr Runs usual_runs = Runs::on_thread;
#endif

/// Returns the most work (compare::WorkEstimate::cost()) of one part of what may take `work` on a thread. In slices it
/// is some 50 ms, in which nothing is drawn.
constexpr std::uint64_t work_of_part(std::uint64_t work) {
  return usual_runs == Runs::in_slices ? std::min<std::uint64_t>(work, 50'000'000) : work;
}

/// Has one Task answer questions, one after another. Whoever asks does not wait for the answer.
/// Task: has the types Question and Answer, and a member
///   std::optional<Answer> advance(const Question& question, Background<Task>& background)
/// that does the next part of the work on a question, and returns the answer with the last part. It throws nothing. The
/// Task may keep data from one part to the next, and from one question to the next. It may have a member
///   static constexpr int rests
/// so that the thread rests after each part, for this multiple of the time that the part took.
template <class Task>
class Background {
 public:
  using Question = typename Task::Question;
  using Answer = typename Task::Answer;
  using Clock = std::chrono::steady_clock;

  /// of_task: the arguments of the Task's constructor.
  template <class... Arguments>
  explicit Background(Runs runs = usual_runs, Arguments&&... of_task) : task_(std::forward<Arguments>(of_task)...) {
    if (runs == Runs::on_thread) thread_ = std::thread([this] { work(); });
  }
  /// Waits for the end of the present part. Further parts and questions are dropped.
  ~Background() {
    cancel(true);
    if (thread_.joinable()) thread_.join();
  }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  /// Returns true if all questions are answered and the task has rested. rests: the rest after an answer, in multiples
  /// of the time that the answer took. With 2 the task takes at most a third of a core from the simulation and the
  /// drawing.
  bool ready(int rests = 2) const {
    assert(rests >= 0);
    const std::scoped_lock lock(mutex_);
    return is_idle() && Clock::now() >= answered_ + rests * took_;
  }

  /// Returns true if a question is not answered yet, or take() has not returned its answer.
  bool has_work() const {
    const std::scoped_lock lock(mutex_);
    return !is_idle() || latest_;
  }

  /// Returns how many questions wait: their answers have not been begun.
  std::size_t waiting() const {
    const std::scoped_lock lock(mutex_);
    return waiting_.size();
  }

  /// Takes the question. Does not wait for the answer.
  void offer(Question question) {
    const std::scoped_lock lock(mutex_);
    if (is_idle()) cancelled_ = false;
    waiting_.push_back(std::move(question));
    wake_.notify_all();
  }

  /// Asks the task to end its work on the questions that are not answered yet. They have answers nevertheless.
  void cancel() { cancel(false); }
  /// Returns true after cancel(), until the first question that is offered when all others are answered.
  bool cancelled() const {
    const std::scoped_lock lock(mutex_);
    return cancelled_;
  }

  /// Returns the latest answer, once; nothing if there is no new one. Call it once for each picture: without a thread
  /// it does the next parts until `slice` is spent, at least one.
  std::optional<Answer> take(Clock::duration slice = std::chrono::milliseconds(3)) {
    do_parts(Clock::now() + slice);
    const std::scoped_lock lock(mutex_);
    return std::exchange(latest_, std::nullopt);
  }

  /// Returns the same, but waits until all questions are answered, or until `end`.
  std::optional<Answer> wait(Clock::time_point end = Clock::time_point::max()) {
    do_parts(end);
    std::unique_lock lock(mutex_);
    wake_.wait_until(lock, end, [this] { return is_idle(); });
    return std::exchange(latest_, std::nullopt);
  }

  /// Makes this the latest answer. Tasks show so how far they have got.
  void publish(Answer so_far) {
    std::optional<Answer> latest(std::move(so_far));
    const std::scoped_lock lock(mutex_);
    latest_.swap(latest);
  }
  /// Returns true if take() has returned what was published.
  bool was_taken() const {
    const std::scoped_lock lock(mutex_);
    return !latest_;
  }

 private:
  bool is_idle() const { return !question_ && waiting_.empty(); }

  void cancel(bool end) {
    const std::scoped_lock lock(mutex_);
    cancelled_ = true;
    ending_ = end;
    wake_.notify_all();
  }

  void work() {
    std::unique_lock lock(mutex_);
    while (true) {
      wake_.wait(lock, [this] { return ending_ || !is_idle(); });
      if (ending_) return;
      lock.unlock();
      [[maybe_unused]] const Clock::duration took = do_part();
      lock.lock();
      if constexpr (requires { Task::rests; })
        if (question_) wake_.wait_for(lock, Task::rests * took, [this] { return cancelled_; });
    }
  }

  /// Does the next parts until `end`, at least one, if there is no thread for them.
  void do_parts(Clock::time_point end) {
    if (thread_.joinable()) return;
    for (bool in_time = true; in_time && !is_idle(); in_time = Clock::now() < end) do_part();
  }

  /// Does the next part. Returns how long it took. Questions and answers may be large: nothing waits until they are
  /// freed.
  Clock::duration do_part() {
    if (const std::scoped_lock lock(mutex_); !question_) {
      question_.emplace(std::move(waiting_.front()));
      waiting_.pop_front();
      took_ = {};
    }
    const Clock::time_point start = Clock::now();
    std::optional<Answer> answer = task_.advance(*question_, *this);
    const Clock::time_point end = Clock::now();
    std::optional<Question> answered;
    const std::scoped_lock lock(mutex_);
    answered_ = end;
    took_ += end - start;
    if (answer) {
      latest_.swap(answer);
      question_.swap(answered);
      wake_.notify_all();
    }
    return end - start;
  }

  mutable std::mutex mutex_;  // guards the members below, except the task
  std::condition_variable wake_;
  std::deque<Question> waiting_;
  std::optional<Question> question_;  // that is being answered
  std::optional<Answer> latest_;
  bool cancelled_ = false, ending_ = false;
  Clock::time_point answered_;
  Clock::duration took_{};  // for all parts of the last answer
  Task task_;
  std::thread thread_;  // none: it works in slices
};

/// Calls a function. Answers with what it throws; null: nothing. A task for Background.
struct Call {
  using Question = std::function<void()>;
  using Answer = std::exception_ptr;
  std::optional<Answer> advance(const Question& call, const Background<Call>&) {
    try {
      call();
      return nullptr;
    } catch (...) {
      return std::current_exception();
    }
  }
};

/// Calls `action` beside the window, and `meanwhile` after each `interval` until `action` ends. Throws what either
/// throws, but not before `action` ends.
inline void call_beside(std::function<void()> action, std::chrono::milliseconds interval,
                        const std::function<void()>& meanwhile, Runs runs = usual_runs) {
  Background<Call> task(runs);
  task.offer(std::move(action));
  std::optional<std::exception_ptr> thrown;
  while (!(thrown = task.wait(Background<Call>::Clock::now() + interval))) meanwhile();
  if (*thrown) std::rethrow_exception(*thrown);
}

}  // namespace app
