#pragma once
// The comparison of methods beside the world that is shown.

#include "app/base/time_series.h"
#include "app/compare/compare.h"
#include "app/compare/method_style.h"
#include "app/compare/run_figures.h"
#include "collide/methods.h"
#include "softbody/world/bodies_in_motion.h"

namespace app::session {

/// What to compare with the driving method, which is compared with the reference in any case.
struct CompareChoice {
  bool on = false;                                        // whether the shown methods are compared
  compare::MethodSet methods = compare::usual_methods();  // that the user wants to see, in all views
  bool with_paper = false;                                // whether the paper's method is compared, too
  bool with_misses = false;                               // whether `misses_of` is compared, too
  std::size_t misses_of = compare::method_index(collide::paper_method);
};

class LiveComparison {
 public:
  /// Number of times that each chosen method is timed while the state stays the same.
  static constexpr int times_per_state = 15;
  static constexpr std::uint32_t seed = 1;  // of the shuffled order: every run of the demo shuffles alike

  CompareChoice choice;

  /// Takes the report that is ready, if any, and offers the present state if more is to be found out about it. Methods
  /// that have joined the table since the last call are taken in.
  /// revision: names the state, ascending; world_number: another number, another world; rests: see
  /// Background::ready().
  void exchange(const softbody::BodiesInMotion& world, std::uint64_t revision, std::uint64_t world_number, int rests);
  /// Returns true if exchange() must be called again, though the state of this revision stays.
  bool awaits_report(std::uint64_t revision) const { return wants_report(revision) || comparison_.has_work(); }
  /// Another world: reports of states before this revision are dropped.
  void restart(const softbody::BodiesInMotion& world, std::uint64_t revision);
  /// Drops the curves of other settings; their report stays until a new one arrives.
  void detection_changed(const softbody::BodiesInMotion& world, std::uint64_t revision);

  /// The method is another one from now on, under the same row: drops what is known of the one before.
  void method_changed(std::size_t method);

  /// Returns the report of a state that is a few frames old. Its vertices still exist.
  const compare::CompareReport& report() const { return report_; }
  /// Counts the reports, so that a new one is noticed.
  std::uint64_t reports() const { return reports_; }
  /// Returns the methods to show side by side: those of the choice, and the driving one.
  compare::MethodSet shown_methods() const;
  /// The index of the driving method in collide::method_table(), and its scored_row().
  std::size_t driver() const { return driver_; }
  const compare::CompareRow* driver_row() const { return scored_row(driver_); }
  /// The row of a method: nullptr until it is measured, or if it cannot be.
  const compare::CompareRow* scored_row(std::size_t method) const;
  /// What CompareChoice::misses_of missed; nullptr if that is not known.
  const std::vector<collide::Contact>* missed() const { return missed_by(choice.misses_of); }
  const std::vector<collide::Contact>* missed_by(std::size_t method) const {
    const compare::CompareRow* row = scored_row(method);
    return row ? &row->missed : nullptr;
  }
  const compare::CompareRow* paper_row() const { return scored_row(compare::method_index(collide::paper_method)); }

  /// What a method missed in all frames that it was compared on, each once, since the start or the last change of
  /// settings. Its times are not summed.
  const compare::RunTotals& sum(std::size_t method) const { return sums_[method]; }

  // By frame: recall of the driver; ms of each method.
  const TimeSeries& recall() const { return recall_; }
  const std::vector<TimeSeries>& method_ms() const { return method_ms_; }

 private:
  bool wants_report(std::uint64_t revision) const;
  compare::MethodSet chosen() const;
  void keep(compare::CompareReport report);
  void forget_times();

  collide::Settings settings_;
  std::size_t driver_ = 0;
  compare::CompareReport report_;
  std::uint64_t reports_ = 0, offered_ = 0, first_wanted_ = 0;
  int offers_ = 0;                      // of the state offered_, with the same methods
  bool outdated_ = false;               // the next report: a method has changed since it was asked for
  compare::MethodSet offered_methods_;  // empty: none but the driver
  TimeSeries recall_;
  std::vector<TimeSeries> method_ms_ = std::vector<TimeSeries>(choice.methods.size());
  std::vector<compare::RunTotals> sums_ = std::vector<compare::RunTotals>(choice.methods.size());
  Background<compare::Comparison> comparison_{usual_runs, seed};
};

}  // namespace app::session
