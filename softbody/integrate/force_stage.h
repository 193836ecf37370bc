#pragma once
// The stages of forces in a plan.

#include "softbody/forces/table.h"
#include "softbody/integrate/plan.h"

namespace softbody {

template <class F>
inline constexpr Stage stage_of = Stage(int(Stage::first_force) + int(index_of<F>));

}  // namespace softbody
