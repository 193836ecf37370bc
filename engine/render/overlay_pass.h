#pragma once
// Draws lines, points and boxes over the scene, each set in one instanced draw.

#include <filesystem>
#include <span>
#include <vector>

#include "engine/frame_data.h"
#include "engine/gl.h"
#include "engine/program.h"

namespace engine::render {

class OverlayPass {
 public:
  explicit OverlayPass(const std::filesystem::path& shaders);
  void draw(const FrameData& frame);

 private:
  template <class Draw>
  void draw_occluded_and_visible(const Program& program, float occluded_alpha, const Draw& draw);
  void draw_lines(std::span<const Line> lines, float width, float occluded_alpha);
  void draw_points(const PointSet& set, float scale);
  void draw_faces(const BoxSet& set);

  // True: GL_LINES, false: rectangles. Software renderers draw a wide line in half the time of the two triangles of a
  // rectangle. Other drivers, and browsers, may not support the width, or draw it less exactly.
  bool uses_gl_lines_;
  std::vector<Line> line_vertices_;  // for GL_LINES: each line twice, once per end
  Program line_program_, point_program_, box_program_;
  VertexArray line_array_, point_array_, box_array_;
  Buffer line_buffer_, point_buffer_, box_buffer_;
  int faint_set_ = 0;  // the last set that was drawn faintly, as in the stencil; 0: none
};

}  // namespace engine::render
