#include "softbody/integrate/dynamics.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace softbody {

Extent Dynamics::extent(const Batch& b, const Components& boxed, const Components& measured) const {
  Extent e{};
  kernels_of(b).extent(b.particles(), at(boxed, b), at(measured, b), e);
  return e;
}

double Dynamics::max_particle_speed(const Batch& b) const { return extent(b, x_, v_).max_length(); }

void Dynamics::set_plan(const Plan& plan) {
  force_set_.set_plan(plan.forces());
  resistance_.set_plan(plan);
  has_gravity_ = plan.has(Stage::gravity);
  has_restitution_ = plan.has(Stage::restitution);
  has_surface_ = plan.has(Stage::surface_contact);
  has_solid_features_ = plan.has(Stage::solid_features);
  self_contact_ = scene_.collision.self_collision;
  if (!has_surface_) surface_.clear();
  if (!plan.has(stage_of<PenaltyContact>)) penalty_.pairs.clear();
}

void Dynamics::set_integrator(const Integrator& integrator) {
  chosen_ = integrator_ = &integrator;
  why_ = {};
  resize_scratch();
}

void Dynamics::resize_scratch() {
  scratch_.resize(std::size_t(integrator_->scratch));
  for (auto& components : scratch_)
    for (auto& c : components) c.resize(x_[0].size());
}

std::size_t Dynamics::particle_count() const {
  std::size_t count = 0;
  for (const Batch& b : batches_) count += b.particles() * std::size_t(b.used);
  return count;
}

bool Dynamics::moves(const Batch& b) {
  return std::any_of(b.moves.begin(), b.moves.end(), [](float m) { return m > 0; });
}

void Dynamics::contact_forces(const Worker& worker, float h) {
  if (penalty_.pairs.empty()) return;
  penalty_.evaluate(worker.part(penalty_.pairs.size()), {x_[0].data(), x_[1].data(), x_[2].data()},
                    {v_[0].data(), v_[1].data(), v_[2].data()}, h);
  worker.barrier();
}

void Dynamics::contacts(const Worker& worker, float h, float since_start) {
  surface_contacts(worker, h, since_start);
  solids(worker, h);
  for (int pass = 0; pass < SurfaceContact::max_passes && has_surface_ && surface_.needs_more_iterations(h); ++pass) {
    worker.barrier();
    if (!surface_.resolve_after_solids(worker.index(), crew_.active(), {v_[0].data(), v_[1].data(), v_[2].data()}, h,
                                       [&] { worker.barrier(); }))
      break;
    solids(worker, h);
  }
}

void Dynamics::surface_contacts(const Worker& worker, float h, float since_start) {
  if (!has_surface_ || surface_.empty()) return;
  worker.barrier();  // the velocities of all bodies are there
  surface_.make_rows(worker.index(), crew_.active(), {x_[0].data(), x_[1].data(), x_[2].data()},
                     {v_[0].data(), v_[1].data(), v_[2].data()},
                     since_found_[std::size_t(worker.index())] + since_start, h);
  worker.barrier();
  surface_.solve(worker.index(), crew_.active(), {x_[0].data(), x_[1].data(), x_[2].data()},
                 {v_[0].data(), v_[1].data(), v_[2].data()}, h, [&] { worker.barrier(); });
}

/// Calls act(ForceSet, ForceBatch) for a batch in the substep at hand.
template <class Act>
void Dynamics::with_forces(Batch& b, Act act) {
  HeldPoint held{};
  const bool holds = grab_ && &batches_[bodies_[grab_->body].batch] == &b;
  if (holds) {
    held.position = grabbed_point();
    for (std::size_t i = 0; i < 3; ++i) held.corners[i] = slot(bodies_[grab_->body], grab_->corners[i]);
  }
  const auto field = [](Components& c) { return Field<float>{c[0].data(), c[1].data(), c[2].data()}; };
  act(force_set_, ForceBatch{*b.model, std::size_t(&b - batches_.data()), b.base, b.width, b.used, b.moves.data(),
                             field(x_), field(v_), field(f_), step_, scene_.gravity, holds ? &held : nullptr});
}

void Dynamics::all_forces(Batch& b) {
  clear(b, softbody::forces);
  with_forces(b, [](const ForceSet& set, const ForceBatch& batch) { set.add(batch); });
}

void Dynamics::other_forces(Batch& b) {
  clear(b, softbody::forces);
  with_forces(b, [](const ForceSet& set, const ForceBatch& batch) { set.add_unprojected(batch); });
}

void Dynamics::project(Batch& b, Quantity x0, Quantity d) {
  const auto field = [this](Quantity q) {
    Components& c = components(q);
    return Field<float>{c[0].data(), c[1].data(), c[2].data()};
  };
  with_forces(b, [&](const ForceSet& set, const ForceBatch& batch) { set.project(batch, field(x0), field(d)); });
}

void Dynamics::pull(Batch& b) {
  with_forces(b, [](const ForceSet& set, const ForceBatch& batch) { set.kick(batch); });
}

glm::dvec3 Dynamics::grabbed_point() const {
  glm::dvec3 point(0.0);
  for (int i = 0; i < 3; ++i)
    point += grab_->weights[i] * particle(grab_->body, grab_->corners[std::size_t(i)]).position;
  return point;
}

void Dynamics::kick(Batch& b, float h) {
  const glm::vec3 g = has_gravity_ ? h * glm::vec3(scene_.gravity) : glm::vec3(0.0f);
  kernels_of(b).kick({b.particles(), h / float(b.model->particle_mass), g.x, g.y, g.z, b.moves.data()}, at(f_, b),
                     at(v_, b));
}

void Dynamics::drift(Batch& b, float h) { kernels_of(b).drift(b.particles(), h, b.moves.data(), at(v_, b), at(x_, b)); }

}  // namespace softbody
