#pragma once
// The forces that a plan takes.

#include "softbody/mechanics/kernels.h"

namespace softbody {

/// An upper bound of what forces do at one particle of the bodies of a batch: over mass, for stable_step().
struct ForceBound {
  double stiffness = 0, implicit_volume = 0;  // 1/s^2; the latter for Volumes::implicit_
  double damping = 0;                         // 1/s
  double volume_change = 0;                   // share by which a volume differs from that of the start
};

class ForceSet {
 public:
  /// The objects of forces without elements; they must outlive this.
  using Objects = std::tuple<PenaltyContact&, Hand&>;
  explicit ForceSet(const Objects& objects) : objects_(objects) {}

  void set_plan(const ForceMask& taken) { taken_ = taken; }

  /// Adds all forces on the bodies of a batch.
  void add(const ForceBatch& batch);
  /// The same without those that project() or kick() stands for.
  void add_unprojected(const ForceBatch& batch);
  /// Changes velocities by all forces in a substep, v += h (f / m + g). Forces must be 0. After it, they are scratch,
  /// or 0 if the positions have moved, too.
  void advance(const ForceBatch& batch, const Advance& how, LaneVolumes& volumes);
  /// Changes velocities that contacts have changed since advance(), so that they fit the pressure at the end again.
  void press_again(const ForceBatch& batch, LaneVolumes& volumes) const;
  /// XPBD, on the displacements d in a step that started at x0, when the positions are x0 + d. It uses the forces as
  /// scratch. Forces that depend on the volume come first: what they move, the others see.
  void project(const ForceBatch& batch, Field<const float> x0, Field<float> d) const;
  /// Changes velocities by what some forces do in steps that are not made of forces alone.
  void kick(const ForceBatch& batch);

 private:
  template <class Takes>
  void add_if(const ForceBatch& batch, Takes takes);

  Objects objects_;
  ForceMask taken_;
};

/// Returns the bound of the forces inside those bodies of a batch that move. Its particles are at x. projects: XPBD
/// moves the particles, so that only those forces count that act as forces in it.
ForceBound bound_of(const Batch& batch, Field<const float> x, bool projects);

/// Returns the acceleration (m/s^2) of all particles of a model by gravity (m/s^2) and the wind (m/s).
glm::dvec3 uniform_acceleration(const BodyModel& model, const glm::dvec3& gravity, const glm::dvec3& wind);

/// True if some force of a model acts on its bodies from outside.
bool has_external_force(const BodyModel& model);

}  // namespace softbody
