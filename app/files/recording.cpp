#include "app/files/recording.h"

#include "collide/methods.h"

namespace app::files {

glm::vec3 automatic_cell_size(Recording& recording, int levels, float tolerance) {
  const std::shared_ptr<const RecordedFrame> first = recording.frame(0);
  collide::Bodies bodies;
  for (std::uint32_t body = 0; body < first->body_count; ++body) bodies.add(recording.model(body)->shape);
  return collide::automatic_cell_size({first->x, first->y, first->z, &bodies}, levels, tolerance);
}

}  // namespace app::files
