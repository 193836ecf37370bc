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
  constexpr int stride = 10;  // the oracle looks at each frame of this number
  Price price;
  try {
    if (trials_.empty()) begin(how);
    if (!background.cancelled()) {
      auto& [world, figures, oracle] =
          *std::ranges::min_element(trials_, {}, [](const Trial& trial) { return trial.world.frame(); });
      world.step();
      figures.add(world);
      if (world.frame() % stride == 0)
        figures.add(collide::oracle::figures_of(world.simulated().positions, oracle.overlaps(world)));
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
