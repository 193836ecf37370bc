#include "app/compare/price.h"

#include <algorithm>
#include <cassert>

#include "app/base/text.h"

namespace app::compare {

void PriceTrial::begin(HowSimulated how) {
  how.scene.method = collide::default_method;
  how.scene.collision.cell_size.reset();
  trials_.emplace_back(how);
  how.scene.method = collide::paper_method;
  trials_.emplace_back(how);
  trials_.emplace_back(usual_second(trials_.front().world, how.integrator));
}

std::optional<Price> PriceTrial::advance(const HowSimulated& how, const Background<PriceTrial>& background) {
  constexpr int part = 10;  // frames; the oracle looks at the last one
  Price price;
  try {
    if (trials_.empty()) begin(how);
    for (Trial& trial : trials_) {
      for (int i = 0; i < part; ++i) {
        if (background.cancelled()) break;
        trial.world.step();
        trial.figures.add(trial.world);
      }
      trial.figures.add(
          collide::oracle::figures_of(trial.world.simulated().positions, trial.oracle.overlaps(trial.world)));
    }
    if (!background.cancelled() && trials_.back().world.frame() < Price::frames) return std::nullopt;
    assert(trials_.size() == price.runs.size());
    for (std::size_t run = 0; run < price.runs.size(); ++run) {
      const glm::vec3 cell = *trials_[run].world.collision().cell_size;
      price.runs[run] = {std::max({cell.x, cell.y, cell.z}), trials_[run].figures.totals()};
    }
  } catch (const std::exception& error) {  // too little memory must not end the demo
    price.failure = failure_text(error);
  }
  trials_.clear();
  return price;
}

}  // namespace app::compare
