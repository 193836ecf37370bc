#include "app/session/live/beside.h"

#include <algorithm>
#include <utility>

#include "app/session/stability/stability_monitor.h"
#include "softbody/world/measures.h"

namespace app::session {
namespace {

using softbody::BodyId;
using softbody::World;

/// Returns the numbers of all bodies, which ascend.
std::vector<std::uint32_t> numbers(const World& world) {
  std::vector<std::uint32_t> all;
  for (BodyId b = 0; b < world.bodies().count(); ++b) all.push_back(world.body(b).number);
  return all;
}

}  // namespace

glm::dvec3 held_point(const World& world, const softbody::Grab& grab) {
  glm::dvec3 sum(0.0);
  for (int i = 0; i < 3; ++i) sum += grab.weights[i] * world.particle(grab.body, grab.corners[std::size_t(i)]).position;
  return sum;
}

Beside::Beside(std::unique_ptr<World> second, const World& first, const compare::Difference& difference)
    : world_(std::move(second)), difference_(difference) {
  restart(first);
}

void Beside::apply(const World& first, const compare::Difference& difference) {
  const auto [scene, integrator] = difference.applied_to({first.scene(), first.integrator_choice()});
  if (scene != world_->scene()) world_->apply(scene);
  if (integrator != world_->integrator_choice()) world_->set_integrator(integrator);
}

void Beside::restart(const World& first) {
  world_->restore(first.snapshot());
  apply(first, difference_);
  stopped_.clear();
  past_.clear();
  before_last_step_.copy(*world_);
  monitor_.restart();
  for (compare::RunFigures& figures : figures_) figures.go_back(-1);
}

void Beside::differ(const World& first, const compare::Difference& difference) {
  apply(first, difference);
  difference_ = difference;
  if (!stopped_.empty()) restart(first);
}

void Beside::follow(const World& first) {
  if (!stopped_.empty()) return;
  apply(first, difference_);
  const std::vector<std::uint32_t> here = numbers(*world_), there = numbers(first);
  const bool together = first.frame() == world_->frame();  // else bodies have come since the first world stopped
  for (BodyId b = world_->bodies().count(); together && b-- > 0;)
    if (!std::ranges::binary_search(there, here[b])) {
      world_->grab({});
      world_->remove(b);
      before_last_step_.copy(*world_);
      for (compare::RunFigures& figures : figures_) figures.go_back(figures.totals().frame);
    }
  for (const softbody::AddedBody& added : first.added())
    if (here.empty() || first.body(added.body).number > here.back()) world_->add(added.source);
  if (together) world_->copy_holds(first);
}

void Beside::step(const World& first) {
  before_last_step_.copy(*world_);
  if (stopped_.empty()) {
    std::optional<softbody::Grab> hand = first.grabbed();
    if (hand && hand->body >= world_->bodies().count()) hand.reset();
    if (!hand) hands_apart_.reset();
    if (hand && !hands_apart_) hands_apart_ = held_point(*world_, *hand) - held_point(first, *hand);
    if (hand) hand->target += *hands_apart_;
    if (hand != world_->grabbed()) world_->grab(hand);
    world_->step();
    if (StabilityMonitor::looks_at(*world_))
      if (const auto found = monitor_.check(*world_, softbody::measure_bodies(*world_))) stopped_ = found->what;
  }
  // One that has blown up stays in its frame.
  if (first.frame() > figures_[0].totals().frame) figures_[0].add(first);
  if (world_->frame() > figures_[1].totals().frame) figures_[1].add(*world_);
}

void Beside::go_to(const Kept& kept, const World& first) {
  world_->restore(kept.world);
  difference_ = kept.difference;
  stopped_ = kept.stopped;
  before_last_step_.copy(*world_);
  monitor_.restart();
  figures_[0].go_back(first.frame());
  figures_[1].go_back(world_->frame());
}

void Beside::keep(const std::vector<softbody::Snapshot>& past) {
  past_.insert_or_assign(past.back().frame, keep());
  std::erase_if(past_, [&past](const auto& kept) {
    return !std::ranges::binary_search(past, kept.first, {}, &softbody::Snapshot::frame);
  });
}

void Beside::rewind(const World& first) {
  const auto kept = past_.find(first.frame());
  if (kept == past_.end()) return restart(first);
  std::swap(kept->second.difference, difference_);  // settings stay
  go_to(kept->second, first);
  apply(first, difference_);
}

}  // namespace app::session
