#pragma once
// Lines, points and boxes over the scene, each kind in one instanced draw per set.

#include <vector>

#include "engine/frame_data.h"
#include "engine/gl.h"

namespace engine {

class Overlays {
 public:
  explicit Overlays(const std::filesystem::path& shaders);
  void draw(const FrameData& frame);

 private:
  template <class Draw>
  static void draw_twice(const Program& program, float hidden, const Draw& draw);
  void draw_lines(std::span<const Line> lines, float width, float hidden);
  void draw_points(const PointSet& set, float scale);
  void draw_faces(const BoxSet& set);

  // Drivers in software draw a wide line in half the time of a rectangle's two triangles. Others may not draw it as
  // wide or as exactly as asked for.
  bool axes_alone_;
  std::vector<Line> ends_;  // then each line twice, once for each end
  Program line_program_, point_program_, box_program_;
  VertexArray line_array_, point_array_, box_array_;
  Buffer line_buffer_, point_buffer_, box_buffer_;
};

}  // namespace engine
