#pragma once
// Who takes part in the comparison. Libraries are wrapped as detectors, so that all get the same frame and owe the same
// result: the finished list of contacts, ascending.

#include <functional>
#include <memory>
#include <span>

#include "collide/core/detector.h"

namespace bench {

struct Candidate {
  std::string_view key;
  std::string_view name;  // with the way it is used
  bool forgets;           // forget() before each frame: nothing is kept but memory
  std::function<std::unique_ptr<collide::Detector>()> make;
};

/// The first one is what the others are divided by.
std::span<const Candidate> candidates();

// The libraries, a file each. They take finite positions only.
std::unique_ptr<collide::Detector> make_embree_rebuild();
std::unique_ptr<collide::Detector> make_embree_refit();
std::unique_ptr<collide::Detector> make_embree_patches();
std::unique_ptr<collide::Detector> make_nanoflann();
std::unique_ptr<collide::Detector> make_cgal();
std::unique_ptr<collide::Detector> make_bullet();

}  // namespace bench
