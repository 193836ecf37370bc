#include "softbody/integrate/implicit/implicit_steps.h"

#include <algorithm>
#include <cassert>

#include <glm/geometric.hpp>

#include "softbody/contact/law.h"
#include "softbody/integrate/implicit/attempts.h"
#include "softbody/integrate/implicit/planes.h"
#include "softbody/integrate/implicit/step_contacts.h"

namespace softbody {
namespace {

LaneMask moving_lanes(const ImplicitBatch& b) {
  LaneMask moving;
  for (std::size_t l = 0; l < implicit_lanes; ++l) moving[l] = b.batch.moves[b.first_lane + l] > 0;
  return moving;
}

void read_start(const ImplicitBatch& b, ImplicitBodies& bodies) {
  for (std::size_t at = 0; at < bodies.x.size() / 3; ++at) {
    const bool taken = b.first_lane + at % implicit_lanes < std::size_t(b.batch.used);
    write(bodies.x, at, taken ? glm::dvec3(read(b.x, b.slot(at))) : glm::dvec3(0.0));
    write(bodies.v, at, taken ? glm::dvec3(read(b.v, b.slot(at))) : glm::dvec3(0.0));
  }
}

void write_end(const ImplicitBodies& bodies, LaneMask moving, double h, const ImplicitBatch& b,
               const ImplicitResult& result) {
  const BodyField mean{result.mean, 0, 1}, rest{result.rest, 0, 1};
  for (std::size_t at = 0; at < bodies.x.size() / 3; ++at) {
    if (!moving[at % implicit_lanes]) continue;
    const glm::dvec3 mean_v = (read(bodies.end_x, at) - read(bodies.x, at)) / h;
    mean.set(b.slot(at), mean_v);
    rest.set(b.slot(at), read(bodies.end_v, at) - mean_v);
  }
}

/// Finds where the held particles of the lanes `moving` end a step of h.
void find_held(const ImplicitBatch& b, LaneMask moving, double h, ImplicitBodies& bodies) {
  bodies.held.clear();
  bodies.holds.reset(), bodies.holds_move.reset();
  for (const HeldParticle& p : b.held) {
    const auto at = b.place(p.slot);
    if (!at || !moving[*at % implicit_lanes]) continue;
    bodies.held.push_back({*at, read(bodies.x, *at) + h * glm::dvec3(p.velocity)});
    bodies.holds.set(*at % implicit_lanes);
    if (p.velocity != glm::vec3(0.0f)) bodies.holds_move.set(*at % implicit_lanes);
  }
}

/// Adds what solids have done to the bodies in the step.
void add_solid_impulses(const ImplicitStep& step, const ImplicitBodies& bodies, const ImplicitBatch& b,
                        const ImplicitResult& result) {
  const BodyField sum{result.solids.impulse, b.first_lane, 1};
  for (const PlaneContact& c : bodies.planes) {
    const std::size_t own = c.point.lane(), lane = b.first_lane + own;
    const double push = glm::dot(c.force, c.normal);
    if (push == 0) continue;
    sum.add(own, step.h * push * c.normal);
    // At the end of the step: until then the spin takes the point along its circle.
    const auto of_point = [&](const Lanes& v) { return c.point.mean([&](std::size_t at) { return read(v, at); }); };
    const glm::dvec3 whole = step.axes.start(own).velocity;
    const double before = glm::dot(whole + step.axes.leave(own, of_point(bodies.v) - whole), c.normal);
    const double after = glm::dot(of_point(bodies.end_v), c.normal);
    result.solids.returned[lane] += float(law::bounce_energy(step.h * push, before, after, c.restitution));
    double work = push * c.out();  // J, with that of who holds corners of a face or an edge
    for (std::size_t k = 0; k < 3; ++k)
      if (const std::size_t at = c.point.at[k]; is_held(bodies, at))
        work -= c.point.weight[k] * glm::dot(c.force, read(bodies.end_x, at) - read(bodies.x, at));
    result.solids.energy[lane] += float(work);
  }
}

/// Adds what the penalty pairs with restitution have done in a step of h.
void add_pair_impacts(const ImplicitBodies& bodies, const ImplicitBatch& b, double h) {
  if (!b.penalty.bounces()) return;
  for (const LinearPenaltyPair& s : bodies.penalty_pairs) {
    if (b.penalty.pairs().restitution[s.end.pair] <= 0) continue;
    const glm::dvec3 moved = read(bodies.end_x, s.at) - read(bodies.x, s.at);
    const double push = glm::dot(s.force_after(moved), s.normal);
    const double before = glm::dot(s.start_separation, s.normal) / h;
    const double after = glm::dot(read(bodies.end_v, s.at) - s.partner / h, s.normal);
    const double impulse = s.share * h * push;
    const glm::dvec3 apart = double(s.end.sign()) * (moved - s.partner);
    const double stored = b.penalty.energy(s.end.pair, b.x, apart) - b.penalty.energy(s.end.pair, b.x);
    b.penalty.add_impact(s.end, impulse, law::bounce_energy(impulse, before, after, 1.0) - s.share * stored);
  }
}

}  // namespace

void ImplicitMatrices::prepare(const BodyModel& model, double h) {
  if (const auto known = std::ranges::find(entries_, h, &Entry::h); known != entries_.end()) {
    std::rotate(known, known + 1, entries_.end());
    return;
  }
  auto matrix = std::make_unique<const ImplicitMatrix>(model, h, entries_.empty() ? nullptr : entries_[0].matrix.get());
  if (entries_.size() >= max_lengths) entries_.erase(entries_.begin());
  entries_.push_back({h, std::move(matrix)});
}

const ImplicitMatrix& ImplicitMatrices::at(double h) const {
  const auto found = std::ranges::find(entries_, h, &Entry::h);
  assert(found != entries_.end());
  return *found->matrix;
}

void ImplicitSteps::retain(const std::function<bool(const BodyModel&)>& in_use) {
  std::erase_if(models_, [&](const auto& entry) { return !in_use(*entry.first); });
}

void ImplicitSteps::prepare(const std::shared_ptr<const BodyModel>& model, double h, int threads) {
  auto& [matrices, work] = models_[model];
  while (work.size() < std::size_t(threads)) work.emplace_back(*model);
  for (const double length : {h, implicit_stage * h}) matrices.prepare(*model, length);
}

void ImplicitSteps::advance(int thread, ImplicitBatch batch, const ImplicitResult& result, double h) {
  const auto found = models_.find(batch.batch.model);
  assert(found != models_.end());
  for (; batch.first_lane < std::size_t(batch.batch.used); batch.first_lane += implicit_lanes)
    advance_part(found->second, thread, batch, result, h);
}

void ImplicitSteps::advance_part(OfModel& own, int thread, const ImplicitBatch& b, const ImplicitResult& result,
                                 double h) {
  const LaneMask moving = moving_lanes(b);
  if (moving.none()) return;
  auto& [solver, bodies, start] = own.work[std::size_t(thread)];
  read_start(b, bodies);
  ImplicitStep step{*b.batch.model,
                    own.matrices.at(h),
                    own.matrices.at(implicit_stage * h),
                    h,
                    b.gravity,
                    MovingAxes(bodies.x, bodies.v, moving, h, b.gravity),
                    solver,
                    start};
  find_held(b, moving, h, bodies);
  step.in_contact = find_planes(b, step.axes, bodies) | find_penalty_pairs(b, moving, h, bodies) | bodies.holds;
  LaneMask open = moving;
  for (const auto attempt : implicit_attempts)
    if (open.any()) open &= ~attempt(step, bodies, open);
  assert(open.none());
  write_end(bodies, moving, h, b, result);
  add_solid_impulses(step, bodies, b, result);
  add_pair_impacts(bodies, b, h);
}

double ImplicitSteps::take_work() {
  double sum = 0;
  for (auto& [model, own] : models_)
    for (Work& work : own.work) sum += work.solver.take_work();
  return sum;
}

}  // namespace softbody
