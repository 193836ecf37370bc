#pragma once
// All keys of a material.

#include <span>

#include "softbody/model/key.h"

namespace softbody {

/// Returns the keys of materials and contact and those of the forces, in the order in which files are written.
std::span<const Key* const> material_keys();

}  // namespace softbody
