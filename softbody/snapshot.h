#pragma once
// A world at an instant, to go back to: every value that has a say in what comes, and none that can be worked out.

#include "softbody/prototype_set.h"
#include "softbody/world.h"

namespace softbody {

/// Taken by World::snapshot(). Meshes and materials are shared with the world.
struct Snapshot {
  Scene scene;  // with the contact surface in use
  PrototypeSet prototypes;
  DynamicsState dynamics;
  std::vector<char> arrived;
  Visitors visitors;
  std::vector<AddedBody> added;
  int drops = 0;
  std::array<double, 2> drop_direction{};
  int frame = 0;
  double time = 0;  // s
  std::string integrator;
  std::optional<int> substeps;
  const collide::Method* method = nullptr;
  collide::Settings settings;
  bool default_cell = true;
  float shield = 0;  // m, how thick it has grown
  Profile profile;   // of the last step, for display

  /// Of memory, without what is shared; a few kilobytes may be missing.
  std::size_t bytes() const;
};

}  // namespace softbody
