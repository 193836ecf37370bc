#include "softbody/integrate/crew.h"

namespace softbody {

Worker::Worker(const Crew& crew, int index) : crew_(crew), index_(index) {
  assert(index >= 0 && index < crew.active());
}

std::span<const Batch* const> Worker::batches() const {
  const auto [begin, end] = part(crew_.moving().size());
  return std::span(crew_.moving()).subspan(begin, end - begin);
}

collide::Part Worker::part(std::size_t count) const { return collide::part_of(count, index_, crew_.active()); }

void Worker::barrier() const {
  if (crew_.active() > 1) crew_.workers().barrier();
}

void Crew::take(std::vector<const Batch*> moving, std::size_t particles) {
  moving_ = std::move(moving);
  active_ = particles >= min_shared_ ? workers_.threads() : 1;
}

void Crew::run(const std::function<void(const Worker&)>& task) const {
  if (active_ == 1)
    task(Worker(*this, 0));
  else
    workers_.run([&](int thread) { task(Worker(*this, thread)); });
}

}  // namespace softbody
