#include "app/report/page.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

#include "app/files/body_file.h"
#include "engine/resources.h"

namespace app::report {

constexpr std::string_view begin_of_plot = "![";  // in Markdown; no other part begins so

std::string command_of(const ReportOptions& o) {
  std::string text = "sbcollide report " + o.name;
  if (o.scene) text.append(" --scene ").append(*o.scene);
  if (!o.files.empty()) {
    text.append(" ").append(o.files.front());
    if (o.files.size() > 2) text += " ...";
    if (o.files.size() > 1) text.append(" ").append(o.files.back());
    text += fmt::format(" --tolerance {:.9g}", *o.tolerance);
  }
  if (o.by)
    text.append(" --bodies ").append(std::ranges::find(files::bodies_by_keys, *o.by, &files::BodiesByKey::value)->key);
  if (o.rest) text.append(" --rest ").append(*o.rest);
  if (o.quick) text += " --quick";
  if (o.threads) text.append(" --threads ").append(std::to_string(*o.threads));
  return text + " --out DIR";
}

std::string Page::part_of_file(const std::string& part) const {
  const std::filesystem::path file = engine::find_folder("assets/reports") / (options_.name + ".txt");
  std::ifstream in(file);
  const std::string parts = '\n' + std::string(std::istreambuf_iterator<char>(in), {}), mark = "\n=== ";
  const auto at = parts.find(mark + part + '\n');
  if (at == parts.npos) throw engine::ResourceError(file.string() + ": cannot be read; install the program again");
  const auto begin = parts.find('\n', at + 1) + 1, end = parts.find(mark, begin);
  return parts.substr(begin, std::min(end, parts.size() - 1) - begin);
}

void Page::add_filled(std::string text) {
  text += '\n';
  constexpr std::string_view empty_item = "- \n";
  for (auto i = text.find(empty_item); i != text.npos; i = text.find(empty_item)) text.erase(i, empty_item.size());
  parts_.push_back(std::move(text));
}

Plot Page::empty_plot(std::string name, const std::string& text) {
  Plot plot{.name = std::move(name), .caption = "", .title = "", .x = "", .y = "", .settings = ""};
  std::istringstream in(text);
  for (std::string* line : {&plot.caption, &plot.title, &plot.x, &plot.y}) std::getline(in, *line);
  plot.settings.assign(std::istreambuf_iterator<char>(in), {});
  if (!plot.settings.empty()) plot.settings += '\n';
  return plot;
}

void Page::warn_if_busy(const TimedParts& timed) {
  constexpr double min_share = 0.9;  // of a core; waits of a few percent are in any long run
  if (!(timed.processor < min_share * timed.wall)) return;
  warning_ = fmt::format("Times may be off: the program got only {:.0f} % of a core while they were taken.",
                         100 * timed.processor / timed.wall);
  text("{}", warning_);
}

void Page::plot(Plot plot) {
  if (plot.series.empty()) return;
  parts_.push_back(fmt::format("{}{}](<{}.svg>)\n", begin_of_plot, plot.caption, plot.name));
  plots_.push_back(std::move(plot));
}

std::string Page::markdown(bool with_plots) const {
  std::string text;
  for (const std::string& part : parts_)
    if (with_plots || !part.starts_with(begin_of_plot)) text.append(text.empty() ? "" : "\n").append(part);
  return text;
}

}  // namespace app::report
