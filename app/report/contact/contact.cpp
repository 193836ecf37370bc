#include <algorithm>
#include <array>

#include "app/files/output_file.h"
#include "app/report/contact/results.h"
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

ContactResults planned(const ReportOptions& options) {
  const bool quick = options.quick;
  ContactResults r{.options = options, .choices = make_choices(quick)};
  if (quick) r.limits = {.frames = 600, .stride = 20, .seconds = 10};
  r.vertex_frames = quick ? 3'000'000 : 10'000'000;
  for (const softbody::Scene& scene : chosen_scenes(options))
    if (!quick || options.scene || std::ranges::count(quick_scenes, scene.key) > 0)
      r.cases.push_back({scene, r.limits});
  for (const Impact impact : options.scene ? std::span<const Impact>() : impacts())
    for (const double speed : quick ? std::span<const double>(quick_speeds) : speeds) {
      const int frames = 60 + int(60 * 0.3 / speed);  // until a second after the ball got there
      r.cases.push_back({impact(speed), {.frames = frames, .stride = 1, .seconds = r.limits.seconds}, speed});
    }
  for (ContactCase& c : r.cases)
    for (const ContactChoice& choice : r.choices) c.trials.push_back({.choice = choice});
  return r;
}

}  // namespace

void report_contact(const ReportOptions& options) {
  ContactResults r = planned(options);
  files::prepare_folder(options.out);
  const std::size_t choices = r.choices.size();
  const auto what = [&](std::size_t i) {
    return r.cases[i / choices].scene.key + ", " + choice_name(r.choices[i % choices]);
  };
  run_in_parallel(options, r.cases.size() * choices, what, [&](std::size_t i) {
    ContactCase& c = r.cases[i / choices];
    ContactTrial& trial = c.trials[i % choices];
    if (vertex_count(c.scene) * std::uint64_t(c.limits.frames) > r.vertex_frames)
      trial.not_run = "over the budget of vertices times frames";
    else
      trial = run_contact_trial(c.scene, trial.choice, c.limits);
  });
  write_report(options, contact_table(r), "contact.md", contact_page(r));
}

}  // namespace app::report
