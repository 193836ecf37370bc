#include "softbody/integrate/crew.h"

#include <algorithm>

namespace softbody {

Worker::Worker(const Crew& crew, int index) : Worker(crew, index, crew.joined(index), false) {}

collide::Part Worker::part(std::size_t count) const {
  return alone_ ? collide::Part{0, 0} : collide::part_of(count, index_, crew_.active());
}

void Worker::barrier() const {
  if (!alone_ && crew_.active() > 1) crew_.workers().barrier();
}

void Crew::take(std::vector<const Batch*> moving, std::size_t particles) {
  moving_ = std::move(moving);
  constexpr double particle_ns = 10;  // of work, between two barriers of a substep
  active_ = workers_.threads_for(particle_ns * double(particles));
  share([](const Batch&) { return 1; });
}

void Crew::share(const std::function<std::size_t(const Batch&)>& cost) {
  joined_.clear(), alone_.clear(), middle_.clear();
  std::size_t sum = 0;
  for (const Batch* b : moving_) {
    const std::size_t own = cost(*b);
    (own > 0 ? joined_ : alone_).push_back(b);
    if (own > 0) middle_.push_back(sum + own / 2);
    sum += own;
  }
  total_cost_ = sum;
}

std::span<const Batch* const> Crew::joined(int thread) const {
  assert(thread >= 0 && thread < active_);
  const auto first = [&](int t) {  // of the batches whose middle lies in the thread's part of all costs
    const std::size_t before = total_cost_ * std::size_t(t) / std::size_t(active_);
    return std::size_t(std::ranges::lower_bound(middle_, before) - middle_.begin());
  };
  return std::span(joined_).subspan(first(thread), first(thread + 1) - first(thread));
}

void Crew::for_each(std::size_t count, const std::function<void(std::size_t)>& use) const {
  workers_.share(active_, count, [&](int, std::size_t i) { use(i); });
}

void Crew::run(const std::function<void(const Worker&)>& task) const {
  if (active_ == 1)
    task(Worker(*this, 0));
  else
    workers_.run_together(active_, [&](int thread) { task(Worker(*this, thread)); });
}

}  // namespace softbody
