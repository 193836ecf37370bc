#pragma once
// The subdivided boxes of the paper's method on one frame (collide::methods::PaperStructure), seen from the vertices.

#include <vector>

#include <glm/vec3.hpp>

#include "collide/core/points.h"
#include "collide/methods/detectors.h"

namespace app::ui {

/// Returns the boxes of a body.
collide::Range boxes_of(const collide::DebugGeometry& structure, collide::Index body);

/// Returns the box of the body that holds one of its vertices, which is at `at`: the upper box if `at` is on a cut
/// (§2.1). One of the boxes must hold it.
collide::Index box_of(const collide::DebugGeometry& structure, collide::Index body, const glm::vec3& at);

/// Returns those of the contacts that the paper's method misses: the boxes of their vertices share no bucket.
std::vector<collide::Contact> missed_contacts(const collide::DebugGeometry& structure, const collide::Frame& frame,
                                              const std::vector<collide::Contact>& contacts);

}  // namespace app::ui
