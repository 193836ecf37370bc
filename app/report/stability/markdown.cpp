#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/core.h>

#include "app/report/stability/results.h"
#include "app/report/table.h"

namespace app {
namespace {

std::string introduction(const StabilityResults& r) {
  constexpr StabilityBounds b = stability_bounds;
  std::string text = fmt::format(
      "# Stability: extreme cases\n\n`{}` makes this report. All figures are the same on every machine.\n\n",
      r.command);
  text += fmt::format("- Every case runs for {:g} s, by every integrator, in frames of 1/30, 1/60 and 1/240 s, ",
                      r.seconds);
  text += r.from_file ? "with all stiffnesses and pressures of the scene times a factor. "
                      : "with springs of 10 to 1e8 N/m (bend springs a fourth of it, gas pressure in proportion). ";
  text +=
      "Named integrators take exactly one step of their own a frame (of XPBD's it has 20 substeps): where they blow up "
      "is the finding. Only `auto` chooses its steps.\n"
      "- A cell passes if: everything is finite; ";
  text += "energy, of motion, springs, gas, gravity and what bodies have put into the shields between them, ";
  text += fmt::format(
      "never exceeds that of the start and work from outside by more than {:g} max(E0 - E_eq, m g R); the fastest "
      "particle and the longest box stay within what this energy can give; ",
      b.energy);
  text += fmt::format(
      "no particle is ever deeper than {:g} R in a solid (after 10 frames where it began inside), nor deeper than {:g} "
      "R in the last quarter; no body goes through a solid; ",
      b.transient, b.steady);
  text += fmt::format("and at the end shape (RMS, moved and turned to fit) is within {:g} R, volume within {:g} % and ",
                      b.shape, 100 * b.volume);
  text += fmt::format("motion within the body no more than {:g} m/s above a reference's.\n", b.rest);
  text +=
      "- Reference: RK4 in double, written apart from the solvers, settled, back in its shape (where nothing but "
      "springs and gas acts), and unchanged within 0.1 % when its step is halved or its start disturbed by 1e-7 R. "
      "Where there is none, the case is "
      "marked * with the reason below its table, and judged on the rest.\n"
      "- Bodies have, where they start or join, their own energy and all that the shields' pairs hold there. What the "
      "first frame of one that joins adds to it, or carries it into, is not credited. E0 - E_eq and m g R are those of "
      "all bodies that have begun or joined by then.\n"
      "- Shields push out what they find behind a surface. The potential of such a pair appears when it is found. "
      "It is not credited: what it adds to the bodies counts as a gain. What bodies put into a pair by pressing it "
      "further is energy of theirs.\n"
      "- `stability.csv` has every figure of every cell.\n";
  if (r.quick) text += "- This is the quick report: fewer cases and stiffnesses, and half the time.\n";
  return text + "\n";
}

std::string share(std::size_t part, std::size_t whole) { return fmt::format("{} of {}", part, whole); }

/// Cells that pass, by integrator and length of a frame.
std::string overview(const StabilityResults& r) {
  Cells names{"integrator"};
  for (const double dt : r.dts) names.push_back(fmt::format("1/{:.0f} s", 1 / dt));
  names.push_back("all");
  std::string text = fmt::format("## Cells that pass\n\n{}", heading(names, 1));
  for (std::size_t i = 0; i < r.integrators.size(); ++i) {
    std::vector<std::size_t> passed(r.dts.size() + 1), all(r.dts.size() + 1);
    for (const StabilitySection& section : r.sections)
      for (const StabilityRow& row : section.rows)
        for (const StabilityCell& cell : row.cells) {
          if (cell.integrator != i) continue;
          for (const std::size_t column : {cell.dt, r.dts.size()}) passed[column] += cell.passes(), ++all[column];
        }
    Cells cells{std::string(r.integrators[i]->name)};
    for (std::size_t c = 0; c < all.size(); ++c) cells.push_back(share(passed[c], all[c]));
    text += line(cells);
  }
  return text + "\n";
}

/// "ok", or the lengths of frames that fail.
std::string verdict(const StabilityResults& r, const StabilityRow& row, std::size_t integrator) {
  std::string failing;
  std::size_t count = 0;
  for (const StabilityCell& cell : row.cells) {
    if (cell.integrator != integrator || cell.passes()) continue;
    ++count;
    failing += fmt::format("{}1/{:.0f}", failing.empty() ? "fails " : ", ", 1 / r.dts[cell.dt]);
  }
  return count == 0 ? "ok" : count == r.dts.size() ? "fails" : failing;
}

/// Why stiffnesses are marked, one reason after another.
std::string marks_of(const StabilitySection& section) {
  std::map<std::string, std::string> marked;
  for (const StabilityRow& row : section.rows) {
    std::string& which = marked[row.untold];
    which += fmt::format("{}{:g}", which.empty() ? "" : ", ", row.stiffness);
  }
  marked.erase("");
  std::string text;
  for (const auto& [why, which] : marked) text += fmt::format("{}{}: {}", text.empty() ? "\n\\* " : "; ", which, why);
  return text.empty() ? "" : text + ".\n";
}

std::string section_text(const StabilityResults& r, const StabilitySection& section) {
  Cells names{"integrator"};
  for (const StabilityRow& row : section.rows)
    names.push_back(fmt::format("{}{:g}{}{}", r.from_file ? "x " : "", row.stiffness, r.from_file ? "" : " N/m",
                                row.untold.empty() ? "" : " *"));
  std::string text = fmt::format("### {}\n\n{}", section.name, heading(names, names.size()));
  for (std::size_t i = 0; i < r.integrators.size(); ++i) {
    Cells cells{std::string(r.integrators[i]->name)};
    for (const StabilityRow& row : section.rows) cells.push_back(verdict(r, row, i));
    text += line(cells);
  }
  return fmt::format("{}{}\n", text, marks_of(section));
}

/// What fails, in words, for the integrators that are meant to stand everything.
std::string failing_cells(const StabilityResults& r) {
  std::string text;
  for (const StabilitySection& section : r.sections)
    for (const StabilityRow& row : section.rows)
      for (const StabilityCell& cell : row.cells) {
        const softbody::Integrator& integrator = *r.integrators[cell.integrator];
        if (cell.passes() || std::isfinite(integrator.stable_step(1, 0))) continue;
        std::string why;
        for (const std::string& f : failures(cell.figures)) why += fmt::format("{}{}", why.empty() ? "" : "; ", f);
        text += line({std::string(integrator.name), section.name, fmt::format("{:g}", row.stiffness),
                      fmt::format("1/{:.0f}", 1 / r.dts[cell.dt]), why});
      }
  if (text.empty()) return {};
  return fmt::format("## Why they fail\n\nOf the integrators that have no largest stable step:\n\n{}{}\n",
                     heading({"integrator", "case", "stiffness", "dt, s", "what is wrong"}, 5), text);
}

std::string steps_table(const StabilityResults& r) {
  if (r.steps.empty()) return {};
  Cells names{"integrator"};
  for (const StableStep& s : r.steps.front()) names.push_back(fmt::format("{:g} N/m", s.stiffness));
  std::string text = fmt::format("## Largest stable step, and its predicted bound, ms\n\n{}", heading(names, 1));
  const auto ms = [](double seconds) {
    return seconds >= longest_step_tried ? fmt::format(">= {:g}", 1e3 * longest_step_tried)
                                         : fmt::format("{:.3g}", 1e3 * seconds);
  };
  for (std::size_t i = 0; i < r.steps.size(); ++i) {
    Cells cells{std::string(r.integrators[i]->name)};
    for (const StableStep& s : r.steps[i])
      cells.push_back(std::isfinite(s.predicted) ? fmt::format("{} ({})", ms(s.found), ms(s.predicted)) : ms(s.found));
    text += line(cells);
  }
  return text;
}

}  // namespace

std::string stability_markdown(const StabilityResults& results, const std::vector<Plot>& plots) {
  std::string text = fmt::format("{}{}## Cases\n\n", introduction(results), overview(results));
  for (const StabilitySection& section : results.sections) text += section_text(results, section);
  return fmt::format("{}{}{}{}", text, failing_cells(results), steps_table(results), picture(plots, stable_step_plot));
}

}  // namespace app
