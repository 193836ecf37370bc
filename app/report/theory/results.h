#pragma once
// What `report theory` measures beside closed forms, and its table and page.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/reference/body_shape.h"
#include "app/report/page.h"
#include "app/report/worlds.h"

namespace app::report {

/// A measured value beside that of a closed form.
struct Comparison {
  std::string what{};  // which value, if a run has several
  double theory, measured;
  std::optional<double> error{};  // if it is not the difference as a share of `theory`
  std::optional<double> bound{};  // of the error; nothing: errors must fall as the integrator's order says
  double deviation() const { return error ? *error : (measured - theory) / std::abs(theory); }
};

/// A value over time.
struct Signal {
  std::vector<double> t{0}, value{};  // s
};

/// A run of one case: one integrator with one number of steps.
struct TheoryRun {
  const softbody::Integrator& by;
  int substeps;  // of a frame; 0: its own
  int variant;   // of the case
  bool quick;

  // What is found.
  std::vector<Comparison> comparisons{};
  int most_substeps = 0;  // of a frame
  double substeps_done = 0;
  double substep = 0;                      // s, the last one
  const softbody::Integrator* took = &by;  // the one that `auto` chose
  double ms = 0;                           // of solving

  /// Returns the scene's world with this integrator. change: of each particle of the first body at the start.
  softbody::World begin(const softbody::Scene& scene,
                        const std::function<void(softbody::Particle&)>& change = {}) const;
  /// Simulates frames, of `planned` if these are more. Throws SceneError where they take too much work.
  void step(softbody::World& world, int frames, const std::function<void()>& after_substep = {}, int planned = 0);
  /// Simulates so many frames, and returns the value at the start and after each substep, or some of them.
  Signal sample(softbody::World& world, int frames, const std::function<double(const collide::Frame&)>& value);
  /// Returns what the rounding of a position in each substep comes to, as a share.
  double rounding() const { return substeps_done * 0x1p-23; }
};

struct TheoryCase {
  std::string key, name;
  std::vector<std::string> variants;
  bool refines;  // the variants are meshes from coarse to fine
  void (*measure)(TheoryRun& run);
  int order = 4;  // at most, of convergence
};

/// The cases, a function for each file.
std::vector<TheoryCase> motion_cases();
std::vector<TheoryCase> shell_cases();
std::vector<TheoryCase> held_cases();
std::vector<TheoryCase> long_cases();

/// Returns how a body moves as a whole.
inline reference::RigidMotion motion_of(const softbody::World& world, softbody::BodyId body = 0) {
  return reference::rigid_motion(reference::state_of(world, body));
}

struct TheoryRow : Comparison {
  const TheoryCase* of;
  const softbody::Integrator* integrator;
  int variant, finer;  // finer: 1: with the integrator's own steps; else with so many times as many
  double rate = 0;     // steps in a second
  double ms = 0;
  std::string failure{};  // empty: the error is as small as it is to be
};

Table theory_table(const std::vector<TheoryRow>& rows);
Page theory_page(const ReportOptions& options, const std::vector<TheoryRow>& rows);

/// Makes the report: how far each integrator is from closed forms.
void report_theory(const ReportOptions& options);

}  // namespace app::report
