#include "app/session/live/price_monitor.h"

#include <utility>

namespace app::session {

void PriceMonitor::exchange(const softbody::World* world) {
  if (!on) return;
  std::optional<compare::HowSimulated> now;
  if (world && world->bodies().vertex_count() <= max_vertices) now = {world->scene(), world->integrator_choice()};
  if (now) now->scene.method = collide::default_method;  // the trial has methods and cells of its own
  if (now) now->scene.collision.cell_size.reset();
  if (now != asked_) {
    asked_.reset();  // the answer of a trial that was cancelled is not whole
    price_.reset();
    trial_.cancel();
  }
  if (auto price = trial_.take(); price && asked_) price_ = std::move(price);
  if (asked_ || !now || trial_.has_work()) return;
  asked_ = now;
  trial_.offer(*now);
}

}  // namespace app::session
