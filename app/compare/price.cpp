#include "app/compare/price.h"

#include <algorithm>
#include <utility>

namespace app::compare {

void PriceTrial::begin(HowSimulated how) {
  collide::Settings& settings = how.scene.collision;
  how.scene.method = run_ == Price::exact ? collide::default_method : collide::paper_method;
  settings.cell_size.reset();
  world_.emplace(how.scene, softbody::World::Options{.integrator = how.integrator});
  if (run_ == Price::small_cells) {
    settings.cell_size = 0.5f * world_->automatic_cell_size(settings.levels);
    world_.emplace(std::move(how.scene), softbody::World::Options{.integrator = how.integrator});
  }
  figures_.emplace();
}

std::optional<Price> PriceTrial::advance(const HowSimulated& how, const Background<PriceTrial>& background) {
  constexpr int part = 10;  // frames; the oracle looks at the last one
  try {
    if (!world_) begin(how);
    for (int i = 0; i < part && !background.cancelled(); ++i) {
      world_->step();
      figures_->add(*world_);
    }
    figures_->add(collide::oracle::figures_of(world_->simulated().positions, oracle_.overlaps(*world_), {}));
    if (!background.cancelled() && world_->frame() < Price::frames) return std::nullopt;
    const glm::vec3 cell = *world_->collision().cell_size;
    price_.runs[run_] = {std::max({cell.x, cell.y, cell.z}), figures_->totals()};
    world_.reset();
    if (!background.cancelled() && ++run_ < price_.runs.size()) return std::nullopt;
  } catch (const std::exception& error) {  // too little memory must not end the demo
    price_.failure = error.what();
  }
  world_.reset();
  run_ = 0;
  return std::exchange(price_, {});
}

}  // namespace app::compare
