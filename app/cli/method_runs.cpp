#include "app/cli/method_runs.h"

#include <exception>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

#include "app/base/streams.h"
#include "app/base/usage_error.h"
#include "app/compare/compare.h"
#include "app/compare/score.h"

namespace app::cli {
namespace {

/// One method on its way over the frames.
struct Runner {
  MethodRun run;
  std::unique_ptr<collide::Detector> detector{};
  std::uint64_t work = 0;  // done so far

  /// Begins a run over the sequence.
  void restart() { detector = run.method->make(); }
  /// Searches a frame, and notes its figures in the first run over the sequence.
  void search(std::size_t frame, const SequenceTask& task, collide::Workers& workers, collide::Result& result) {
    if (!task.reuse) detector->forget();
    const collide::Frame view = task.frames[frame].view();
    const double ms = compare::timed_search(*detector, view, task.settings, workers, result);
    if (frame == run.rows.size())
      run.rows.push_back({result.contacts.size(), result.self_contacts, result.counters, result.skipped, {}, {}});
    run.rows[frame].times.ms.push_back(ms);
    work += compare::WorkEstimate{result.counters.pair_tests, result.counters.hashes}.cost();
  }
};

class SideBySide {
 public:
  explicit SideBySide(const SequenceTask& task) : task_(task), workers_(task.threads) {
    for (const collide::Method& method : collide::method_table()) runners_.push_back({{&method, {}, {}}});
  }

  MethodRuns run() {
    MethodRuns all;
    for (repetition_ = 0; repetition_ < task_.repeat; ++repetition_) {
      for (Runner& runner : runners_) runner.restart();
      for (std::size_t f = 0; f < task_.frames.size(); ++f) {
        cost_model_.begin(task_.frames[f].view(), task_.settings, 0);
        if (repetition_ == 0 && f == 0) choose_reference();
        truth_.reset();
        if (reference_) search(*reference_, f);
        for (std::size_t m = 0; m < runners_.size(); ++m)
          if (m != reference_) search(m, f);
      }
    }
    clear_progress();
    if (reference_) all.reference = runners_[*reference_].run.method;
    for (Runner& runner : runners_) all.runs.push_back(std::move(runner.run));
    return all;
  }

 private:
  void search(std::size_t m, std::size_t f) {
    Runner& runner = runners_[m];
    if (!runner.run.not_run.empty()) return;
    if (const std::uint64_t work = work_with(m, f); work > max_work) {
      refuse(runner, f, fmt::format("would take {} a frame", cost_model_.of(m).in_words()));
      return;
    }
    show_progress(fmt::format("frame {} of {}: {}", f + 1, task_.frames.size(), runner.run.method->name));
    try {
      runner.search(f, task_, workers_, result_);
    } catch (const std::exception& error) {  // out of memory, or more contacts than a detector may report
      refuse(runner, f, error.what());
      return;
    }
    cost_model_.learn(m, result_.counters);
    if (repetition_ > 0) return;
    if (m == reference_) truth_ = result_.contacts;
    if (!truth_) return;
    const compare::Score score = compare::score(result_.contacts, *truth_);
    Found& found = runner.run.rows[f].found.emplace(Found{truth_->size(), truth_->size() - score.missed.size()});
    if (!score.missed.empty()) found.first_missed = score.missed.front();
    found.first_false = score.first_false;
  }

  /// Returns the work that the method will have done at the end if each frame from this one on takes as much as it.
  std::uint64_t work_with(std::size_t m, std::size_t f) const {
    const auto frames = std::uint64_t(task_.frames.size()), repeat = std::uint64_t(task_.repeat);
    const std::uint64_t left = (repeat - std::uint64_t(repetition_)) * frames - f;
    return runners_[m].work + left * cost_model_.of(m).cost();
  }

  void refuse(Runner& runner, std::size_t f, const std::string& why) {
    runner.run.not_run = f == 0 && repetition_ == 0 ? why : fmt::format("from frame {} on: {}", f, why);
  }

  void choose_reference() {
    const auto can_run = [&](std::size_t m) { return work_with(m, 0) <= max_work; };
    const collide::Method& exact = *collide::find_method(collide::default_method);
    reference_ = compare::choose_reference(exact, can_run);
    if (const std::size_t m = compare::method_index(exact.key); !reference_ && can_run(m)) reference_ = m;
  }

  const SequenceTask& task_;
  collide::Workers workers_;
  std::vector<Runner> runners_;  // by method
  compare::CostModel cost_model_;
  std::optional<std::size_t> reference_;
  std::optional<std::vector<collide::Contact>> truth_;  // of the frame
  collide::Result result_;
  int repetition_ = 0;
};

}  // namespace

MethodRun run_method(const collide::Method& method, const SequenceTask& task, const ContactsSink& sink) {
  Runner runner{{&method, {}, {}}};
  collide::Workers workers(task.threads);
  collide::Result result;
  for (int repetition = 0; repetition < task.repeat; ++repetition) {
    runner.restart();
    for (std::size_t f = 0; f < task.frames.size(); ++f) {
      try {
        runner.search(f, task, workers, result);
      } catch (const std::length_error& error) {
        throw UsageError(task.files[f] + ": " + error.what());
      }
      if (repetition == 0) sink(f, result.contacts);
    }
  }
  return std::move(runner.run);
}

MethodRuns run_all_methods(const SequenceTask& task) { return SideBySide(task).run(); }

}  // namespace app::cli
