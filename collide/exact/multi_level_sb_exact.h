#pragma once
// The exact method of the table in collide/methods.cpp. collide/README.md lists its stages, in the order of a frame.

#include <memory>

#include "collide/core/detector.h"

namespace collide::exact {

std::unique_ptr<Detector> make_multi_level_sb_exact();

}  // namespace collide::exact
