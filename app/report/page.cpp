#include "app/report/page.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "engine/resources.h"

namespace app::report {

std::string warn_of_busy_machine(const TimedParts& timed) {
  constexpr double min_share = 0.9;  // of a core; waits of a few percent are in any long run
  if (!(timed.processor < min_share * timed.wall)) return {};
  return fmt::format("Times may be off: the program got only {:.0f} % of a core while they were taken.",
                     100 * timed.processor / timed.wall);
}

void Page::fill(const std::string& part, fmt::format_args holes) {
  const std::filesystem::path file = engine::find_folder("assets/reports") / (report_ + ".txt");
  std::ifstream in(file);
  const std::string patterns = '\n' + std::string(std::istreambuf_iterator<char>(in), {}), mark = "\n=== ";
  const auto at = patterns.find(mark + part + '\n');
  if (at == patterns.npos) throw engine::ResourceError(file.string() + ": cannot be read; install the program again");
  const auto begin = patterns.find('\n', at + 1) + 1, end = patterns.find(mark, begin);
  std::string text = fmt::vformat(patterns.substr(begin, std::min(end, patterns.size() - 1) + 1 - begin), holes);
  constexpr std::string_view empty_item = "- \n";
  for (auto i = text.find(empty_item); i != text.npos; i = text.find(empty_item)) text.erase(i, empty_item.size());
  parts_.push_back(std::move(text));
}

void Page::warn(const std::string& text) {
  if (text.empty()) return;
  parts_.push_back(text + "\n");
  warnings_.push_back(text);
}

void Page::plot(Plot plot) {
  if (plot.series.empty()) return;
  plots_.push_back(std::move(plot));
  parts_.emplace_back();
}

std::string Page::markdown(bool with_plots) const {
  std::string text;
  auto plot = plots_.begin();
  for (const std::string& part : parts_) {
    if (part.empty() && !with_plots) continue;
    if (!text.empty()) text += '\n';
    text += part;
    if (!part.empty()) continue;
    text += fmt::format("![{}](<{}.svg>)\n", plot->caption, plot->name);
    ++plot;
  }
  return text;
}

}  // namespace app::report
