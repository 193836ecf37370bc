#include <cmath>

#include "app/base/usage_error.h"
#include "app/files/output_file.h"
#include "app/report/files.h"
#include "app/report/theory/results.h"
#include "softbody/model/body_model.h"

namespace app::report {

softbody::World TheoryRun::begin(const softbody::Scene& scene,
                                 const std::function<void(softbody::Particle&)>& change) const {
  return start_world(scene, {.integrator = with_steps(by, substeps)},
                     change ? changed_start(scene, change) : std::vector<Particles>());
}

void TheoryRun::step(softbody::World& world, int frames, const std::function<void()>& after_substep, int planned) {
  const double most_work = quick ? 5e6 : 2e8;  // particles times substeps
  for (int frame = 0; frame < frames; ++frame) {
    world.step(after_substep);
    require_whole_frame(world);
    const softbody::StepReport& done = world.last_step();
    ms += done.solve_ms, substeps_done += done.substeps, substep = done.last_substep, took = done.integrator;
    most_substeps = std::max(most_substeps, done.substeps);
    const double work = by.implicit ? 300 : 1;  // of a particle in a substep
    if (work * done.substeps * std::max(frames, planned) * double(world.positions().x.size()) > most_work)
      throw softbody::SceneError("too many steps");
  }
}

Signal TheoryRun::sample(softbody::World& world, int frames,
                         const std::function<double(const collide::Frame&)>& value) {
  Signal signal{.value = {value(world.positions())}};
  for (int frame = 0; frame < frames; ++frame) {
    const int every = 1 + most_substeps / 100;
    int steps = 0;
    const auto look = [&] {
      if (++steps % every == 0) signal.value.push_back(value(world.positions()));
    };
    step(world, 1, look, frames);
    for (int i = every; i <= steps; i += every) signal.t.push_back((frame + double(i) / steps) * world.frame_time());
  }
  return signal;
}

namespace {

/// Says which rows fail. rows: of a case by one integrator on one variant, from few steps to many.
void judge(std::vector<TheoryRow>& rows) {
  constexpr double exact = 1e-4, lacking = 0.3;  // of an error that need not fall; of the order
  for (TheoryRow& row : rows) {
    if (!row.failure.empty()) continue;
    const TheoryRow *coarse = nullptr, *fine = nullptr;
    for (const TheoryRow& r : rows)
      if (r.what == row.what) coarse = std::exchange(fine, &r);
    if (!std::isfinite(row.deviation())) row.failure = "not finite";
    if (row.bound && std::abs(row.deviation()) > *row.bound) row.failure = "too far";
    if (row.bound || !coarse || std::abs(fine->deviation()) < exact) continue;
    const double falls = std::log(std::abs(coarse->deviation() / fine->deviation())) / std::log(2.0);
    if (falls < std::min(row.of->order, row.integrator->order) - lacking) row.failure = "falls too slowly";
  }
}

/// Returns the rows of a case by one integrator on one variant: with its own steps, and with more.
std::vector<TheoryRow> measure(const TheoryCase& c, int variant, const softbody::Integrator& integrator, bool quick) {
  std::vector<TheoryRow> rows;
  int own = 1;
  for (const int finer : {1, 2, 4}) {
    if (finer > (c.refines ? (quick ? 1 : 2) : (quick ? 2 : 4)) || (finer > 1 && (integrator.automatic || variant > 0)))
      break;
    TheoryRun run{integrator, finer == 1 ? 0 : finer * own, variant, quick};
    TheoryRow row{{}, &c, &integrator, variant, finer};
    try {
      c.measure(run);
    } catch (const softbody::SceneError& error) {
      row.failure = error.what();
      rows.push_back(row);
      break;
    }
    if (finer == 1) own = std::max(1, run.most_substeps / integrator.substeps_per_step);
    row.rate = 1 / run.substep, row.ms = run.ms;
    for (Comparison& comparison : run.comparisons) {
      static_cast<Comparison&>(row) = std::move(comparison);
      rows.push_back(row);
    }
  }
  judge(rows);
  return rows;
}

}  // namespace

void report_theory(const ReportOptions& options) {
  if (options.scene) throw UsageError("report theory: it has scenes of its own; leave out --scene");
  files::prepare_folder(options.out);
  std::vector<TheoryCase> cases;
  for (const auto& some : {motion_cases(), shell_cases(), held_cases(), long_cases()})
    cases.insert(cases.end(), some.begin(), some.end());
  struct Task {
    const TheoryCase& of;
    const softbody::Integrator& integrator;
    int variant;
    std::vector<TheoryRow> rows{};
  };
  std::vector<Task> tasks;
  for (const TheoryCase& c : cases)
    for (const softbody::Integrator& i : softbody::integrators())
      for (int v = 0; v < int(c.variants.size()); ++v)
        if (v == 0 || !c.refines || (!options.quick && (i.automatic || i.key == "semi-implicit-euler")))
          tasks.push_back({c, i, v});
  run_in_parallel(
      options, tasks.size(), [&](std::size_t i) { return tasks[i].of.key; },
      [&](std::size_t i) {
        tasks[i].rows = measure(tasks[i].of, tasks[i].variant, tasks[i].integrator, options.quick);
      });
  std::vector<TheoryRow> rows;
  for (const Task& task : tasks) rows.insert(rows.end(), task.rows.begin(), task.rows.end());
  write_report(options, theory_table(rows), "theory.md", theory_page(options, rows));
}

}  // namespace app::report
