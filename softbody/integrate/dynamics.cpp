#include "softbody/integrate/dynamics.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "softbody/forces/kernels.h"
#include "softbody/forces/shape_matching.h"
#include "softbody/state/kernels.h"

namespace softbody {

Extent Dynamics::extent(const Batch& b, const Components& boxed, const Components& measured) const {
  Extent e{};
  state_kernels(b.width).extent(b.used, b.particles(), at(boxed, b), at(measured, b), e);
  return e;
}

double Dynamics::max_particle_speed(const Batch& b) const { return extent(b, x_, v_).max_length(); }

void Dynamics::set_plan(const Plan& plan) {
  static constexpr std::pair<Stage, BatchStage> springs_and_gas[] = {
      {Stage::structural_springs, &Dynamics::structural_springs},
      {Stage::bend_springs, &Dynamics::bend_springs},
      {Stage::shear_springs, &Dynamics::shear_springs},
      {Stage::gas_pressure, &Dynamics::gas_pressure},
  };
  static constexpr std::pair<Stage, BatchStage> others[] = {
      {Stage::shape_matching, &Dynamics::shape_matching},
      {Stage::contact_response, &Dynamics::penalty_forces},
  };
  force_stages_.clear();
  other_force_stages_.clear();
  for (const auto& [stage, run] : springs_and_gas)
    if (plan.has(stage)) force_stages_.push_back(run);
  for (const auto& [stage, run] : others) {
    if (!plan.has(stage)) continue;
    force_stages_.push_back(run);
    other_force_stages_.push_back(run);
  }
  if (plan.has(Stage::grab)) force_stages_.push_back(&Dynamics::grab_force);  // last: it reckons with the others
  resistance_.set_plan(plan);
  has_gravity_ = plan.has(Stage::gravity);
  has_restitution_ = plan.has(Stage::restitution);
  has_surface_ = plan.has(Stage::surface_contact);
  has_solid_features_ = plan.has(Stage::solid_features);
  self_contact_ = scene_.collision.self_collision;
  if (!has_surface_) surface_.clear();
  if (!plan.has(Stage::contact_response)) penalty_.pairs.clear();
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

void Dynamics::run_stages(Batch& b, std::span<const BatchStage> stages) {
  clear(b, softbody::forces);
  for (const BatchStage stage : stages) (this->*stage)(b);
}

void Dynamics::all_forces(Batch& b) { run_stages(b, force_stages_); }
void Dynamics::other_forces(Batch& b) { run_stages(b, other_force_stages_); }

void Dynamics::structural_springs(Batch& b) {
  force_kernels(b.width).springs(b.used, b.mesh->structural, at(x_, b), at(v_, b), at(f_, b));
}
void Dynamics::bend_springs(Batch& b) {
  force_kernels(b.width).springs(b.used, b.mesh->bend, at(x_, b), at(v_, b), at(f_, b));
}
void Dynamics::shear_springs(Batch& b) {
  force_kernels(b.width).springs(b.used, b.mesh->shear, at(x_, b), at(v_, b), at(f_, b));
}

void Dynamics::gas_pressure(Batch& b) {
  if (!b.model->has_gas) return;
  const Gas& gas = b.model->gas;
  float volume[lanes], gauge[lanes]{};
  force_kernels(b.width).volume(b.used, b.mesh->faces, at(x_, b), volume);
  for (int l = 0; l < b.used; ++l) gauge[l] = static_cast<float>(gas.gauge(double(volume[l])));
  force_kernels(b.width).pressure(b.used, b.mesh->faces, at(x_, b), gauge, at(f_, b));
}

void Dynamics::shape_matching(Batch& b) {
  if (b.mesh->shape.empty()) return;
  ShapeMoments<float> moments;
  ShapePose<float> pose{};
  force_kernels(b.width).shape_moments(b.used, b.mesh->shape, at(x_, b), moments);
  fit_shape(moments, b.used, pose);
  force_kernels(b.width).shape_pull(b.used, b.mesh->shape, pose, static_cast<float>(shape_stiffness(*b.model)),
                                    at(x_, b), at(f_, b));
}

void Dynamics::penalty_forces(Batch& b) {
  if (penalty_.pairs.empty()) return;
  const auto index = static_cast<std::size_t>(&b - batches_.data());
  for (std::uint32_t e = penalty_.first_end[index]; e < penalty_.first_end[index + 1]; ++e) {
    const PenaltyEnd& end = penalty_.ends[e];
    for (std::size_t k = 0; k < 3; ++k) f_[k][end.slot] += end.sign * penalty_.force[end.pair][int(k)];
  }
}

void Dynamics::kick(Batch& b, float h) {
  const glm::vec3 g = has_gravity_ ? h * glm::vec3(scene_.gravity) : glm::vec3(0.0f);
  state_kernels(b.width).kick(b.used, {b.particles(), h / float(b.model->particle_mass), g.x, g.y, g.z, b.moves.data()},
                              at(f_, b), at(v_, b));
}

void Dynamics::accelerations(Batch& b) {
  const glm::vec3 g = has_gravity_ ? glm::vec3(scene_.gravity) : glm::vec3(0.0f);
  state_kernels(b.width).accelerate(
      b.used, {b.particles(), float(1 / b.model->particle_mass), g.x, g.y, g.z, b.moves.data()}, at(f_, b));
}

void Dynamics::drift(Batch& b, float h) {
  state_kernels(b.width).drift(b.used, b.particles(), h, b.moves.data(), at(v_, b), at(x_, b));
}

}  // namespace softbody
