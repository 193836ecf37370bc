#include <algorithm>

#include <fmt/core.h>

#include "app/report/contact/results.h"
#include "app/report/table.h"

namespace app {

std::string choice_name(const ContactChoice& choice) {
  if (choice.surface == softbody::ContactSurface::surfaces) return "Surface";
  return fmt::format("Vertex-vertex, {}, x {:g}", choice.method == collide::paper_method ? "literal" : "exact",
                     choice.tolerance);
}

namespace {

std::string introduction(const ContactResults& r) {
  std::string text = fmt::format(
      "# Contact: how true it is, and what it costs\n\n`{}` makes this report. All figures but the times are the same "
      "on every machine.\n\n",
      r.command);
  text +=
      "- Every scene, and spheres thrown at 1 to 1,000 m/s, run with surface contact and with the paper's "
      "vertex-vertex "
      "contact at several tolerances, \"x 1\" being the scene's own (0.2 R for the spheres). An oracle that shares no "
      "code with detectors and response looks on.\n"
      "- Vertex-vertex contact runs with the literal method and with one of the exact ones. All others are exact: they "
      "find the same contacts, so the bodies move alike; `report detection` says what each costs. Surface contact has "
      "one search of its own, which is exact; detector and tolerance do not change what it does: one row.\n";
  text += fmt::format(
      "- Overlaps are looked for every {} frames (impacts: every frame). Penetrating: vertices inside another body, a "
      "look. Missed: the share that no contact of the detector joins to that body. R: radius of the smallest closed "
      "body.\n",
      r.limits.stride);
  text +=
      "- Passed: vertices that came to the other side of a surface from one frame to the next (where bodies are slow, "
      "from one centimetre of motion to the next), summed. Each is taken along a straight line, which cuts the corners "
      "of its curved way; so one that went in and out counts only if its bodies passed each other by more than R. "
      "`contact.csv` has the raw passages of vertices through faces and edges through edges, too. Through a "
      "solid: bodies whose middle went through one.\n"
      "- Jitter: RMS speed over the last second of the particles whose bodies do not sleep.\n"
      "- ms: processor time of a step on one thread, mean over the frames until all bodies slept.\n";
  text += fmt::format(
      "- Fails: not finite; anything passed or went through a solid; a body pierces itself at the end; deeper than "
      "{:g} R at the end, or ever in a solid; in scenes with gravity also: not asleep at the end, {} frames.\n",
      ContactTrial::depth_bound, r.limits.frames);
  text += fmt::format(
      "- Budget: scenes with more than {} vertices times frames, and runs of more than {:g} s of processor time, are "
      "listed as over it.\n",
      whole(static_cast<double>(r.vertex_frames)), r.limits.seconds);
  text += "- `contact.csv` has every figure.\n";
  if (r.quick) text += "- This is the quick report: fewer scenes, frames, speeds and tolerances.\n";
  return text + "\n";
}

std::string in_radii(double depth, const ContactTrial& t) { return t.radius > 0 ? brief(depth / t.radius) : ""; }

std::string missed_share(std::size_t missed, std::size_t penetrations, const ContactChoice& choice) {
  if (choice.surface == softbody::ContactSurface::surfaces || penetrations == 0) return "";
  return fmt::format("{:.1f} %", 100 * static_cast<double>(missed) / static_cast<double>(penetrations));
}

std::string verdict(const ContactTrial& t) {
  std::string text;
  for (const std::string& f : t.failures()) text += fmt::format("{}{}", text.empty() ? "" : "; ", f);
  return text.empty() ? "ok" : text;
}

// ---- all scenes ----

/// One choice over all scenes in which every choice was run.
struct Total {
  std::size_t run = 0, failing = 0, looks = 0, penetrations = 0, missed = 0, passed = 0, through = 0, awake = 0;
  double deepest = 0, end_depth = 0, mean_depth = 0, jitter = 0, ms = 0;  // depths in R; mean_depth a sum

  void add(const ContactTrial& t) {
    ++run;
    failing += !t.failures().empty();
    looks += static_cast<std::size_t>(t.looks);
    penetrations += t.penetrations;
    missed += t.missed;
    passed += t.passed;
    through += t.through_solids;
    awake += t.settles && !t.asleep;
    jitter = std::max(jitter, t.jitter);
    ms += t.cpu_ms;
    if (t.radius == 0) return;
    deepest = std::max(deepest, t.deepest / t.radius);
    end_depth = std::max(end_depth, t.end_depth / t.radius);
    mean_depth += static_cast<double>(t.penetrations) * t.mean_depth / t.radius;
  }
};

std::string overview(const ContactResults& r) {
  std::string text = fmt::format(
      "## All scenes\n\nOver the scenes that were run with every choice: sums, and for depths at the end and jitter "
      "the worst.\n\n{}",
      heading({"contact", "scenes that fail", "penetrating", "missed", "deepest, R", "mean, R", "at the end, R",
               "passed", "through a solid", "awake", "jitter, mm/s", "ms"},
              1));
  for (std::size_t i = 0; i < r.choices.size(); ++i) {
    Total total;
    for (const ContactCase& c : r.cases) {
      const bool run = std::ranges::all_of(c.trials, [](const ContactTrial& t) { return t.not_run.empty(); });
      if (!c.impact && run) total.add(c.trials[i]);
    }
    const double count = static_cast<double>(std::max<std::size_t>(total.penetrations, 1));
    text += line({choice_name(r.choices[i]), fmt::format("{} of {}", total.failing, total.run),
                  whole(static_cast<double>(total.penetrations)),
                  missed_share(total.missed, total.penetrations, r.choices[i]), brief(total.deepest),
                  brief(total.mean_depth / count), brief(total.end_depth), whole(static_cast<double>(total.passed)),
                  whole(static_cast<double>(total.through)), whole(static_cast<double>(total.awake)),
                  brief(1e3 * total.jitter), brief(total.ms)});
  }
  return text + "\n";
}

// ---- one scene ----

std::string scene_section(const ContactCase& c, const std::vector<Plot>& plots) {
  const bool none = std::ranges::none_of(c.trials, [](const ContactTrial& t) { return t.not_run.empty(); });
  std::string text = fmt::format("### {}\n\n", c.name);
  if (none) return fmt::format("{}Not run: {}.\n\n", text, c.trials.front().not_run);
  text += heading({"contact", "penetrating", "missed", "deepest, R", "mean, R", "at the end, R", "passed",
                   "solid depth, mm", "jitter, mm/s", "ms", "verdict"},
                  1);
  for (const ContactTrial& t : c.trials) {
    if (!t.not_run.empty()) {
      text += line({choice_name(t.choice), "", "", "", "", "", "", "", "", "", t.not_run});
      continue;
    }
    text += line({choice_name(t.choice), brief(static_cast<double>(t.penetrations) / t.looks),
                  missed_share(t.missed, t.penetrations, t.choice), in_radii(t.deepest, t), in_radii(t.mean_depth, t),
                  in_radii(t.end_depth, t), whole(static_cast<double>(t.passed)), brief(1e3 * t.solid_depth),
                  brief(1e3 * t.jitter), brief(t.cpu_ms), verdict(t)});
  }
  return fmt::format("{}{}\n", text, picture(plots, contact_plot_name(c)));
}

// ---- impacts ----

/// A row a choice, a column a speed.
std::string impact_section(std::span<const ContactCase> cases, const std::vector<Plot>& plots) {
  Cells names{"contact"};
  for (const ContactCase& c : cases) names.push_back(fmt::format("{:g} m/s", c.speed));
  std::string text = fmt::format("### {}\n\n{}", cases.front().name, heading(names, names.size()));
  for (std::size_t i = 0; i < cases.front().trials.size(); ++i) {
    Cells cells{choice_name(cases.front().trials[i].choice)};
    for (const ContactCase& c : cases) cells.push_back(verdict(c.trials[i]));
    text += line(cells);
  }
  return fmt::format("{}{}\n", text, picture(plots, contact_plot_name(cases.front())));
}

}  // namespace

std::string contact_markdown(const ContactResults& results, const std::vector<Plot>& plots) {
  std::string text = introduction(results) + overview(results) + "## Scenes\n\n";
  const auto first_impact = std::ranges::find(results.cases, true, &ContactCase::impact);
  for (auto c = results.cases.begin(); c != first_impact; ++c) text += scene_section(*c, plots);
  if (first_impact != results.cases.end()) text += "## Impacts\n\n";
  for (auto c = first_impact; c != results.cases.end();) {
    const auto end =
        std::find_if(c, results.cases.end(), [&](const ContactCase& other) { return other.key != c->key; });
    text += impact_section({c, end}, plots);
    c = end;
  }
  return text;
}

}  // namespace app
