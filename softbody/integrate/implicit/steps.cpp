#include "softbody/integrate/implicit/steps.h"

#include <cassert>

#include <glm/geometric.hpp>

#include "softbody/integrate/implicit/attempts.h"
#include "softbody/integrate/implicit/contact_search.h"

namespace softbody {
namespace {

LaneMask moving_lanes(const ImplicitBatch& b) {
  LaneMask moving;
  for (std::size_t l = 0; l < lanes; ++l) moving[l] = b.moves[l] > 0;
  return moving;
}

void read_start(const ImplicitBatch& b, ImplicitWork& work) {
  for (std::size_t at = 0; at < work.x.size() / 3; ++at) {
    write(work.x, at, glm::dvec3(read(b.x, b.base + at)));
    write(work.v, at, glm::dvec3(read(b.v, b.base + at)));
  }
}

void write_end(const ImplicitWork& work, LaneMask moving, double h, std::size_t base, const ImplicitResult& result) {
  const BodyField mean{result.mean, base, 1}, rest{result.rest, base, 1};
  for (std::size_t at = 0; at < work.x.size() / 3; ++at) {
    if (!moving[at % lanes]) continue;
    const glm::dvec3 mean_v = (read(work.end_x, at) - read(work.x, at)) / h;
    mean.set(at, mean_v);
    rest.set(at, read(work.end_v, at) - mean_v);
  }
}

void add_impulses(const ImplicitWork& work, double h, const ImplicitResult& result) {
  const BodyField sum{result.impulse, 0, 1};
  for (const PlaneContact& c : work.planes) {
    const glm::dvec3 impulse = h * glm::dot(c.force, c.normal) * c.normal;
    sum.add(c.at % lanes, impulse);
    result.returned[c.at % lanes] += float(c.restitution * glm::length(impulse));
  }
}

}  // namespace

void ImplicitSteps::retain(const std::function<bool(const BodyModel&)>& in_use) {
  matrices_.retain(in_use);
  for (auto& of_thread : work_) std::erase_if(of_thread, [&](const auto& entry) { return !in_use(*entry.first); });
}

void ImplicitSteps::prepare(const std::shared_ptr<const BodyModel>& model, double h, int threads) {
  if (work_.size() < std::size_t(threads)) work_.resize(std::size_t(threads));
  for (std::size_t t = 0; t < std::size_t(threads); ++t) work_[t].try_emplace(model, *model, kernels_);
  for (const double length : {h, implicit_stage * h}) matrices_.prepare(model, length);
}

void ImplicitSteps::advance(int thread, const ImplicitBatch& b, const ImplicitResult& result, double h) {
  const auto found = work_[std::size_t(thread)].find(b.model);
  assert(found != work_[std::size_t(thread)].end());
  ImplicitWork& work = found->second;
  read_start(b, work);
  const LaneMask moving = moving_lanes(b);
  ImplicitStep step{*b.model,
                    matrices_.at(*b.model, h),
                    matrices_.at(*b.model, implicit_stage * h),
                    h,
                    b.gravity,
                    ImplicitFrames(work.x, work.v, moving, h, b.gravity)};
  step.in_contact = find_planes(b, step.frames, moving, h, work) | find_penalty_pairs(b, moving, h, work);
  LaneMask open = moving;
  for (const ImplicitAttempt& attempt : implicit_attempts)
    if (open.any()) open &= ~attempt.advance(step, work, open);
  assert(open.none());
  write_end(work, moving, h, b.base, result);
  add_impulses(work, h, result);
}

double ImplicitSteps::take_work() {
  double sum = 0;
  for (auto& of_thread : work_)
    for (auto& [model, work] : of_thread) sum += work.solver.take_work();
  return sum;
}

}  // namespace softbody
