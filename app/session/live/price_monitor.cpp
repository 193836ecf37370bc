#include "app/session/live/price_monitor.h"

#include <utility>

namespace app::session {

void PriceMonitor::exchange(const softbody::World& world) {
  if (!on) return;
  const compare::HowSimulated now{world.scene(), world.integrator_choice()};
  const bool another = !asked_ || now.scene != asked_->scene || now.integrator != asked_->integrator;
  if (auto price = trial_.take(); price && !another) price_ = std::move(price);
  if (!another) return;
  price_.reset();
  trial_.cancel();
  if (trial_.has_work() || world.bodies().vertex_count() > max_vertices) return;
  asked_ = now;
  trial_.offer(now);
}

}  // namespace app::session
