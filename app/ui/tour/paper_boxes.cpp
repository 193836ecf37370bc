#include "app/ui/tour/paper_boxes.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <limits>
#include <span>

#include <glm/common.hpp>

namespace app::ui {

using collide::Index;

collide::Range boxes_of(const collide::DebugGeometry& structure, Index body) {
  const auto& boxes = structure.boxes;
  const auto first = std::ranges::lower_bound(boxes, body, {}, &collide::DebugGeometry::Box::body);
  const auto end = std::ranges::upper_bound(boxes, body, {}, &collide::DebugGeometry::Box::body);
  return {static_cast<Index>(first - boxes.begin()), static_cast<Index>(end - boxes.begin())};
}

Index box_of(const collide::DebugGeometry& structure, Index body, const glm::vec3& at) {
  const collide::Range boxes = boxes_of(structure, body);
  Index box = boxes.end;
  glm::vec3 lower(-std::numeric_limits<float>::infinity());
  for (Index i = boxes.begin; i < boxes.end; ++i) {
    const auto& [lo, hi, owner] = structure.boxes[i];
    const bool holds = glm::max(lo, at) == at && glm::min(hi, at) == at;
    if (!holds || glm::max(lo, lower) != lo) continue;
    lower = lo;
    box = i;
  }
  assert(box < boxes.end);
  return box;
}

std::vector<collide::Contact> missed_contacts(const collide::DebugGeometry& structure, const collide::Frame& frame,
                                              const std::vector<collide::Contact>& contacts) {
  const auto buckets_of = [&](Index vertex) {
    const Index box = box_of(structure, frame.bodies->body_of(vertex), position(frame, vertex));
    return std::span(structure.box_bucket)
        .subspan(structure.box_first[box], structure.box_first[box + 1] - structure.box_first[box]);
  };
  std::vector<collide::Contact> missed;
  std::ranges::copy_if(contacts, std::back_inserter(missed), [&](const collide::Contact& contact) {
    const auto a = buckets_of(contact.a), b = buckets_of(contact.b);
    return std::ranges::find_first_of(a, b) == a.end();
  });
  return missed;
}

}  // namespace app::ui
