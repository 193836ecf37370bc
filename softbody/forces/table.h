#pragma once
// The table of forces. A force is a struct in a file of its own, and its name in this list. What the struct says:
//
//   key                of its stage in the plan
//   keys               of materials (key.h)
//   internal           whether its forces on a body add up to no force and no torque
//   why_not(facts)     why a scene does not need it, or nullptr; without it: `absent`, if no body model has its data
//
// A force inside bodies is a law of a coordinate (coordinates.h). It has
//   coordinate         which one
//   Data, make(model, source)   what the bodies of a model need for the coordinate, or nothing
//   adapt(material, mesh)       changes the values of a material to fit a mesh
//
// Any other force is an object of the solver (ForceSet::Objects, MotionParts). It has
//   add(batch)         adds its forces on the bodies of a batch
//   kick(batch)        changes velocities after all else has, in steps that are not made of forces alone
//
// Forces act in the order of the list.

#include <hwy/base.h>

#include <bitset>
#include <cstddef>
#include <optional>
#include <type_traits>

#include "softbody/forces/air_drag.h"
#include "softbody/forces/gas.h"
#include "softbody/forces/hand.h"
#include "softbody/forces/penalty_contact.h"
#include "softbody/forces/shape_matching.h"
#include "softbody/forces/springs.h"

namespace softbody {

template <class... Force>
struct List {};

using Forces =
    List<StructuralSprings, BendSprings, ShearSprings, GasPressure, ShapeMatching, AirDrag, PenaltyContact, Hand>;

template <class Force>
struct Name {};

/// Calls use(Name<F>{}) for each force F of the list, in its order.
template <class Use, class... Force>
HWY_INLINE constexpr void for_each_force(List<Force...>, Use&& use) {
  (use(Name<Force>{}), ...);
}

inline constexpr std::size_t force_count = []<class... Force>(List<Force...>) { return sizeof...(Force); }(Forces{});

using ForceMask = std::bitset<force_count>;  // in the order of the list

/// The place of a force in the list.
template <class F>
inline constexpr std::size_t index_of = [] {
  std::size_t index = 0, found = force_count;
  for_each_force(Forces{}, [&]<class G>(Name<G>) {
    if constexpr (std::is_same_v<F, G>) found = index;
    ++index;
  });
  return found;
}();

/// True if the force is a law of a coordinate.
template <class F>
concept HasElements = requires {
  typename F::Data;
};

/// Returns the coordinate of which the force is a law; nothing for an object of the solver.
template <class F>
constexpr std::optional<Coordinate> coordinate_of() {
  if constexpr (HasElements<F>) return F::coordinate;
  return {};
}

/// True if the force changes velocities, in steps that are not made of forces alone.
template <class F>
concept Kicks = requires(F& force, const ForceBatch& batch) {
  force.kick(batch);
};

/// True if XPBD moves the particles to where the law has them.
template <class F>
constexpr bool is_projected() {
  return HasElements<F> && coordinate_of<F>() != Coordinate::offset;
}

/// True if the force acts as a force in XPBD.
template <class F>
constexpr bool is_unprojected() {
  return !is_projected<F>() && !Kicks<F>;
}

}  // namespace softbody
