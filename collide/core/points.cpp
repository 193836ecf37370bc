#include "collide/core/points.h"

namespace collide {

void Points::resize(Index count) {
  size_ = count;
  for (auto* coordinate : {&x, &y, &z}) coordinate->resize(std::size_t{count} + padding);
  for (auto* owner : {&vertex, &body}) owner->resize(std::size_t{count} + padding);
}

void Points::gather(const Frame& frame, std::span<const Index> which, std::vector<Range>& ranges) {
  const Bodies& bodies = *frame.bodies;
  resize(bodies.vertex_count());  // an upper bound
  ranges.clear();
  Index slot = 0;
  for (const Index b : which) {
    const Index begin = slot;
    for (Index v = bodies.first[b]; v < bodies.first[b + 1]; ++v) set(slot++, frame, v, b);
    ranges.push_back({begin, slot});
  }
  resize(slot);
}

VertexList::VertexList(const Bodies& bodies, std::span<const Index> which) : bodies_(&bodies), which_(which) {
  first_.reserve(which.size() + 1);
  for (const Index body : which) first_.push_back(first_.back() + bodies.size(body));
}

}  // namespace collide
