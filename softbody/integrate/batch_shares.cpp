#include "softbody/integrate/batch_shares.h"

#include <algorithm>

namespace softbody {

collide::Part BatchShare::part(std::size_t count) const {
  return is_alone ? collide::Part{0, 0} : collide::part_of(count, thread, all.active());
}

void BatchShare::barrier() const {
  if (!is_alone && all.active() > 1) all.workers().barrier();
}

void BatchShares::take(std::vector<const Batch*> moving, std::size_t particles) {
  moving_ = std::move(moving);
  constexpr double particle_ns = 10;  // of work, between two barriers of a substep
  active_ = workers_.threads_for(particle_ns * double(particles));
  deal([](const Batch&) { return 1; });
}

void BatchShares::deal(const std::function<std::size_t(const Batch&)>& cost) {
  for (auto* list : {&joined_, &alone_}) list->clear();
  middle_.clear();
  std::size_t sum = 0;
  for (const Batch* b : moving_) {
    const std::size_t own = cost(*b);
    (own > 0 ? joined_ : alone_).push_back(b);
    if (own > 0) middle_.push_back(sum + own / 2);
    sum += own;
  }
  total_cost_ = sum;
}

BatchShare BatchShares::share(int thread) const {
  assert(thread >= 0 && thread < active_);
  const auto first = [&](int t) {  // of the batches whose middle lies in the thread's part of all costs
    const std::size_t before = total_cost_ * std::size_t(t) / std::size_t(active_);
    return std::size_t(std::ranges::lower_bound(middle_, before) - middle_.begin());
  };
  return {*this, thread, std::span(joined_).subspan(first(thread), first(thread + 1) - first(thread))};
}

void BatchShares::for_each(std::size_t count, const std::function<void(std::size_t)>& use) const {
  workers_.share(active_, count, [&](int, std::size_t i) { use(i); });
}

void BatchShares::run(const std::function<void(const BatchShare&)>& task) const {
  if (active_ == 1)
    task(share(0));
  else
    workers_.run_together(active_, [&](int thread) { task(share(thread)); });
}

}  // namespace softbody
