#include <algorithm>
#include <array>

#include "app/files/output_file.h"
#include "app/report/contact/results.h"
#include "app/report/detection/recording.h"
#include "app/report/files.h"

namespace app::report {
namespace {

// The scenes' own tolerance is 0.2 R for spheres: 0.08, 0.16, 0.2 and 0.4 R.
constexpr std::array tolerances{0.4, 0.8, 1.0, 2.0};
constexpr std::array speeds{1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0};  // m/s
constexpr std::array quick_speeds{10.0, 100.0, 1000.0};
constexpr std::array quick_scenes{"A", "B"};

std::vector<ContactChoice> make_choices(bool quick) {
  using softbody::ContactSurface;
  std::vector<ContactChoice> choices{{.surface = ContactSurface::surfaces}};
  for (const double tolerance : tolerances) {
    if (quick && tolerance != 1) continue;
    for (const std::string_view method : {collide::default_method, collide::paper_method})
      choices.push_back({ContactSurface::vertices, method, tolerance});
  }
  return choices;
}

/// One run.
struct Job {
  softbody::Scene scene;
  TrialLimits limits;
  std::size_t of_case, choice;  // indices
};

class ContactReport {
 public:
  explicit ContactReport(const ReportOptions& options) : options_(options) {
    const bool quick = options.quick;
    results.options = options;
    results.limits = quick ? TrialLimits{.frames = 600, .stride = 20, .seconds = 10} : TrialLimits{};
    results.vertex_frames = quick ? 3'000'000 : 10'000'000;
    results.choices = make_choices(quick);
  }

  void add_scene(const softbody::Scene& scene) {
    const std::uint64_t cost = vertex_count(scene) * static_cast<std::uint64_t>(results.limits.frames);
    const bool over = cost > results.vertex_frames;
    add({.key = scene.key, .name = scene.name}, scene, results.limits, over);
  }

  void add_impact(const Impact& impact, double speed) {
    const softbody::Scene scene = impact.make(speed);
    // Until a second after the ball got there.
    const int frames = 60 + static_cast<int>(60 * 0.3 / speed);
    add({.impact = true, .key = std::string(impact.key), .name = std::string(impact.name), .speed = speed}, scene,
        {.frames = frames, .stride = 1, .seconds = results.limits.seconds}, false);
  }

  void run() {
    collide::Workers workers(options_.threads.value_or(options_.cores));
    const auto what = [&](std::size_t i) {
      return jobs_[i].scene.key + ", " + choice_name(results.choices[jobs_[i].choice]);
    };
    run_in_parallel(workers, jobs_.size(), what, [&](std::size_t i) {
      ContactTrial& trial = results.cases[jobs_[i].of_case].trials[jobs_[i].choice];
      trial = run_contact_trial(std::move(jobs_[i].scene), trial.choice, jobs_[i].limits);
    });
  }

  ContactResults results;

 private:
  void add(ContactCase c, const softbody::Scene& scene, const TrialLimits& limits, bool over_budget) {
    for (const ContactChoice& choice : results.choices) {
      if (!over_budget) jobs_.push_back({scene, limits, results.cases.size(), c.trials.size()});
      c.trials.push_back({.choice = choice, .not_run = over_budget ? "over the budget of vertices times frames" : ""});
    }
    results.cases.push_back(std::move(c));
  }

  const ReportOptions& options_;
  std::vector<Job> jobs_;
};

}  // namespace

void report_contact(const ReportOptions& options) {
  const std::vector<softbody::Scene> scenes = chosen_scenes(options);
  files::prepare_folder(options.out);
  ContactReport report(options);
  for (const softbody::Scene& scene : scenes) {
    if (!options.quick || options.scene || std::ranges::count(quick_scenes, scene.key) > 0) report.add_scene(scene);
  }
  if (!options.scene) {
    for (const Impact& impact : impacts())
      for (const double speed : options.quick ? std::span<const double>(quick_speeds) : speeds)
        report.add_impact(impact, speed);
  }
  report.run();
  write_report(options, contact_table(report.results), "contact.md", contact_page(report.results));
}

}  // namespace app::report
