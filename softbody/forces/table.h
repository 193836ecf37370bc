#pragma once
// The table of forces. A force is a struct in a file of its own, and its name in this list.

#include "softbody/forces/gas.h"
#include "softbody/forces/shape_matching.h"
#include "softbody/forces/springs.h"

namespace softbody {

template <class... Force>
struct List {};

using Forces = List<StructuralSprings, BendSprings, ShearSprings, GasPressure, ShapeMatching>;

}  // namespace softbody
