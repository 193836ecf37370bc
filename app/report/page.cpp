#include "app/report/page.h"

namespace app::report {

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
