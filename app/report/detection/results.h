#pragma once
// What `report detection` measures, and its table, page and plots.

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "app/compare/sweep.h"
#include "app/report/page.h"

namespace app::report {

/// A sweep of one recorded state.
struct StateResult {
  int frame = 0;
  collide::Index bodies = 0, vertices = 0;
  compare::SweepReport sweep;
};

/// The same configurations on several states of a scene or of a recorded sequence.
struct SceneResult {
  std::string scene, name;    // its key and its name; of a sequence the names of its files
  std::uint32_t buckets = 0;  // the scene's own
  std::vector<StateResult> states;
};

struct DetectionResults {
  ReportOptions options{};
  compare::SweepLimits limits{};
  std::vector<SceneResult> scenes{};  // or the one sequence
  SceneResult growth{};  // piles of more and more bodies, cut out of one state; no states if its scene is too small
};

/// One configuration over all states of a scene.
struct Mean {
  compare::Configuration configuration;
  std::string not_run;        // why it was not run on one of them; if empty, all of these have a meaning
  double ms = 0, min_ms = 0;  // means of the states' medians and minima
  double pair_tests = 0, hashes = 0, boxes = 0;             // means
  std::size_t contacts = 0, missed = 0, true_contacts = 0;  // sums
  std::size_t memory = 0;                                   // maximum

  double error() const;  // 1 - recall over all states
  double precision() const;
};

/// Returns the means in the order of the rows of a state's sweep. The scene has a state.
std::vector<Mean> means(const SceneResult& scene);

/// Returns the indices of those on the Pareto front of error against run time.
std::vector<std::size_t> pareto_front(const std::vector<Mean>& means);

/// The paper's scenarios and its level of subdivision (Table 1).
inline constexpr std::array<std::string_view, 4> paper_scenes{"A", "B", "C", "D"};
inline constexpr int paper_level = 3;

inline const collide::Method& method_of(const compare::Configuration& c) { return collide::method_table()[c.method]; }

inline std::string_view group_name(const collide::Method& method) {
  return std::ranges::find(collide::method_groups, method.group, &collide::MethodGroupName::group)->name;
}

// A setting as text; empty if the method does not use it.
std::string levels_of(const compare::Configuration& c);
std::string buckets_of(const compare::Configuration& c);
std::string cell_of(const compare::Configuration& c);

/// Returns detection.csv: every row of every state. What a method does not use, and what was not measured, is empty.
Table detection_table(const DetectionResults& results);

Page detection_page(const DetectionResults& results);
/// Adds the part on what §3 of the paper claims: hashes by level, and growth with the number of bodies.
void add_growth(Page& page, const DetectionResults& results);

}  // namespace app::report
