#pragma once
// The forces that a plan takes.

#include "softbody/forces/kernels.h"

namespace softbody {

/// An upper bound of what forces do at one particle of the bodies of a batch: over mass, for stable_step().
struct ForceBound {
  double stiffness = 0;  // 1/s^2
  double damping = 0;    // 1/s
};

namespace detail {
template <class... Force>
std::tuple<Force...> objects_of(List<Force...>);
}

class ForceSet {
 public:
  explicit ForceSet(Isa isa) : isa_(isa) {}

  void set_plan(const ForceMask& taken) { taken_ = taken; }

  /// Returns the object that a world has of a force.
  template <class F>
  F& of() {
    return std::get<index_of<F>>(objects_);
  }
  template <class F>
  const F& of() const {
    return std::get<index_of<F>>(objects_);
  }

  /// Adds all forces on the bodies of a batch to batch.f.
  void add(const ForceBatch& batch) const;
  /// The same without those that project() or kick() stands for.
  void add_unprojected(const ForceBatch& batch) const;
  /// XPBD, on the displacements d in a step of batch.h that started at x0, when batch.x is x0 + d. It uses batch.f as
  /// scratch. Forces that depend on the volume come first: what they move, the others see.
  void project(const ForceBatch& batch, Field<const float> x0, Field<float> d) const;
  /// Changes batch.v by what some forces do in steps that are not made of forces alone.
  void kick(const ForceBatch& batch) const;

  /// Returns the bound of the forces inside bodies. f: scratch, zero.
  ForceBound bound(const LaneBodies<float>& bodies, int width) const;

 private:
  template <class Takes>
  void add_if(const ForceBatch& batch, Takes takes) const;

  Isa isa_;
  ForceMask taken_;
  decltype(detail::objects_of(Forces{})) objects_;
};

/// True if some force of a model acts on its bodies from outside.
bool has_external_force(const BodyModel& model);

}  // namespace softbody
