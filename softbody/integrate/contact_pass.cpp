#include "softbody/integrate/contact_pass.h"

#include <algorithm>

#include "softbody/contact/keys.h"

namespace softbody {

void ContactPass::set_plan(const Plan& plan) {
  has_surfaces_ = plan.has(Stage::surface_contact);
  if (!has_surfaces_) surfaces_ = {};
}

double ContactPass::wake_hit_sleepers(double seconds) {
  bool moving = false, sleeping = false;
  for (BodyId id = 0; id < state_.body_count(); ++id) {
    moving = moving || state_.body(id).moves();
    sleeping = sleeping || state_.body(id).asleep;
  }
  if (!moving || !sleeping) return 0;
  const double work = find(seconds, seconds, 0);
  for (const collide::surface::SurfacePair& pair : surfaces_.candidates().search().pairs())
    for (const auto& [sleeper, by] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)}) {
      if (!state_.body(sleeper).asleep || !state_.body(by).moves() ||
          state_.max_particle_speed(by) <= 2 * scene_.sleep.speed)
        continue;
      state_.set_asleep(sleeper, false);
      found_ = 0;  // its candidates are others now that it moves
    }
  return work;
}

int ContactPass::covered_substeps(double left, double h) const {
  const double seconds = double(surfaces_.candidates().search().holds_until()) - (found_ - left);
  return std::max(1, int(std::min(seconds / h + 1e-3, 1e6)));
}

collide::Frame ContactPass::world_positions() {
  for (auto* components : {&position_, &velocity_})
    for (auto& c : *components) c.resize(vertices_->vertex_count());
  for (const Batch& b : state_.batches())
    state_.write_positions(b, vertices_->first, {position_[0].data(), position_[1].data(), position_[2].data()});
  return {position_[0], position_[1], position_[2], vertices_};
}

collide::surface::Motion ContactPass::motion(const collide::Frame& now) {
  for (const Batch& b : state_.batches())
    state_.write_velocities(b, vertices_->first, {velocity_[0].data(), velocity_[1].data(), velocity_[2].data()});
  return {now, velocity_[0], velocity_[1], velocity_[2]};
}

double ContactPass::find(double left, double ahead, double least) {
  const collide::Frame now = world_positions();
  const auto elapsed = float(found_ - left);
  if (found_ > 0 && surfaces_.candidates().check_valid(now, elapsed, float(ahead))) return 0;
  if (found_ > 0) {
    surfaces_.candidates().update(motion(now), elapsed, float(ahead), shares_.workers());
    return double(surfaces_.candidates().search().work());
  }
  found_ = left;
  since_found_.assign(std::size_t(shares_.workers().threads()), 0.0f);
  surfaces_.set_threads(shares_.workers().threads());
  std::vector<collide::surface::SurfaceBody> traits;
  std::vector<ContactBody> contacts;
  for (BodyId id = 0; id < state_.body_count(); ++id) {
    const Body& body = state_.body(id);
    const BodyModel& model = state_.model(id);
    const auto edge = float(model.mean_edge);
    const float margin = std::clamp(0.5f * float(model.material[Material::thickness]), 0.001f * edge, 0.1f * edge);
    traits.push_back({model.surface.get(), margin, 0, edge, body.moves()});
    contacts.push_back({body.origin,
                        state_.slot(id, 0),
                        std::size_t(state_.batch_of(id).width),
                        body.moves() ? float(1 / model.particle_mass) : 0.0f,
                        float(model.material[contact::friction]),
                        float(model.material[contact::restitution]),
                        &model.shape->rest(),
                        {state_.held.of(id).begin(), state_.held.of(id).end()}});
  }
  surfaces_.candidates().find(
      motion(now), std::move(traits), std::move(contacts),
      {float(left), float(least), scene_.collision.self_collision, max_candidates_.of(state_.particle_count())},
      float(ahead), shares_.workers());
  keep_overlapping_awake();
  return double(surfaces_.candidates().search().work());
}

void ContactPass::keep_overlapping_awake() {
  for (const SurfaceCandidates::Pair& pair : surfaces_.candidates().pairs())
    if (pair.separating || !surfaces_.candidates().interior(pair).empty())
      for (const Index body : {pair.range.a, pair.range.b}) state_.memory(body).calm_frames = 0;
}

void ContactPass::apply(const BatchShare& share, float h, float since_start) {
  if (!meets_others(share)) return apply_solids(share, h);
  const Field<const float> x = field(std::as_const(state_.x));
  const auto barrier = [&] { share.barrier(); };
  barrier();  // the velocities of all bodies are there
  surfaces_.make_rows(share.thread, shares_.active(), x, solids_.velocities_before(),
                      since_found_[std::size_t(share.thread)] + since_start, h);
  barrier();
  surfaces_.solve(share.thread, shares_.active(), x, field(state_.v), h, barrier);
  apply_after_surfaces(share, h);
}

void ContactPass::apply_solids(const BatchShare& share, float h) {
  for (const Batch* batch : share.batches) solids_.apply(*batch, h);
}

void ContactPass::apply_after_surfaces(const BatchShare& share, float h) {
  constexpr int max_passes = 4;
  const auto barrier = [&] { share.barrier(); };
  apply_solids(share, h);
  for (int pass = 0; pass < max_passes; ++pass) {
    barrier();
    if (!surfaces_.find_islands(share.thread, shares_.active(), field(std::as_const(state_.v)), barrier)) break;
    const std::vector<SurfaceContact::Island>& islands = surfaces_.islands();
    for (auto i = std::size_t(share.thread); i < islands.size(); i += std::size_t(shares_.active()))
      if (islands[i].closes) solve_island(share.thread, islands[i], h);
    barrier();
    apply_solids(share, h);
  }
  if (state_.held.moves()) barrier();  // their velocities are read
  surfaces_.add_row_work(share.thread, shares_.active(), field(std::as_const(state_.v)));
}

/// Solves contacts of bodies together with those of the solids that they lie on, which apply() takes in turn.
void ContactPass::solve_island(int thread, const SurfaceContact::Island& island, float h) {
  std::vector<ContactRow> rows;
  std::vector<std::size_t> end;
  for (const Index body : island.bodies) {
    if (state_.body(body).moves()) solids_.add_particle_rows(body, 2 * h * island.speed, rows);
    end.push_back(rows.size());
  }
  surfaces_.solve_island(thread, island, rows, field(state_.v));
  for (std::size_t i = 0, first = 0; i < end.size(); first = end[i++])
    solids_.book(island.bodies[i], std::span(rows).subspan(first, end[i] - first));
}

void ContactPass::advance(const BatchShare& share, float h) {
  if (has_surfaces_) since_found_[std::size_t(share.thread)] += h;
}

}  // namespace softbody
