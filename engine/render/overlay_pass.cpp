#include "engine/render/overlay_pass.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <tuple>

#include "engine/context.h"
#include "engine/render/frame_uniforms.h"

namespace engine::render {
namespace {

/// An edge parallel to `axis`, from `lo` to `hi`; `at` are its coordinates on the next two axes.
struct Edge {
  int axis;
  std::array<float, 2> at;
  float lo, hi;
  glm::vec4 colour;

  bool is_collinear_with(const Edge& other) const { return axis == other.axis && at == other.at; }
  Line line() const {
    Line line{.a = {}, .b = {}, .colour = colour};
    line.a[axis] = lo;
    line.b[axis] = hi;
    for (int i = 0; i < 2; ++i)
      line.a[(axis + 1 + i) % 3] = line.b[(axis + 1 + i) % 3] = at[static_cast<std::size_t>(i)];
    return line;
  }
};

void append_edges(std::vector<Edge>& edges, const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const float at_u : {box.lo[u], box.hi[u]})
      for (const float at_v : {box.lo[v], box.hi[v]})
        edges.push_back({axis, {at_u, at_v}, box.lo[axis], box.hi[axis], box.colour});
  }
}

/// Returns the edges of all boxes as lines. An edge that several boxes share becomes one line. An edge that continues
/// another in the same colour extends its line. For a grid of boxes, a third of the lines remains.
std::vector<Line> merged_edges(const std::vector<Box>& boxes) {
  std::vector<Edge> edges;
  edges.reserve(12 * boxes.size());
  for (const Box& box : boxes) append_edges(edges, box);
  std::ranges::stable_sort(edges, {}, [](const Edge& e) { return std::tuple(e.axis, e.at, e.lo, e.hi); });
  std::vector<Edge> merged;
  for (const Edge& edge : edges) {
    Edge* last = merged.empty() || !merged.back().is_collinear_with(edge) ? nullptr : &merged.back();
    if (last && last->lo <= edge.lo && last->hi >= edge.hi) continue;
    if (last && last->hi == edge.lo && last->colour == edge.colour)
      last->hi = edge.hi;
    else
      merged.push_back(edge);
  }
  std::vector<Line> lines;
  for (const Edge& edge : merged) lines.push_back(edge.line());
  return lines;
}

bool draws_wide_lines() {
  std::array<float, 2> widths{};  // least and most
  glGetFloatv(GL_ALIASED_LINE_WIDTH_RANGE, widths.data());
  return widths[1] > 1;
}

}  // namespace

OverlayPass::OverlayPass(const std::filesystem::path& shaders)
    : uses_gl_lines_(uses_software_renderer() && draws_wide_lines()),
      line_program_(shaders, "line.vert", "line.frag"),
      point_program_(shaders, "point.vert", "point.frag"),
      box_program_(shaders, "box_faces.vert", "box_faces.frag") {
  line_array_.bind();
  set_attributes(line_buffer_, sizeof(Line),
                 {{3, offsetof(Line, a)}, {3, offsetof(Line, b)}, {4, offsetof(Line, colour)}}, 0,
                 uses_gl_lines_ ? Advance::per_vertex : Advance::per_instance);
  point_array_.bind();
  set_attributes(point_buffer_, sizeof(Point), {{3, offsetof(Point, position)}, {4, offsetof(Point, colour)}});
  box_array_.bind();
  set_attributes(box_buffer_, sizeof(Box),
                 {{3, offsetof(Box, lo)}, {3, offsetof(Box, hi)}, {4, offsetof(Box, colour)}});
}

void OverlayPass::draw(const FrameData& frame) {
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  faint_set_ = 0;
  for (const BoxSet& set : frame.boxes) {
    if (set.boxes.empty()) continue;
    draw_faces(set);
    draw_lines(merged_edges(set.boxes), set.width * frame.pixel_scale, set.occluded_alpha);
  }
  for (const LineSet& set : frame.lines) draw_lines(set.lines, set.width * frame.pixel_scale, set.occluded_alpha);
  for (const PointSet& set : frame.points) draw_points(set, frame.pixel_scale);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

void OverlayPass::draw_lines(std::span<const Line> lines, float width, float occluded_alpha) {
  if (lines.empty()) return;
  line_program_.use();
  line_program_.set("width", width);
  line_program_.set("side_scale", uses_gl_lines_ ? 0.0f : 1.0f);
  line_array_.bind();
  const auto count = static_cast<GLsizei>(lines.size());
  if (uses_gl_lines_) {
    line_vertices_.clear();
    for (const Line& line : lines) line_vertices_.insert(line_vertices_.end(), 2, line);
    line_buffer_.stream(GL_ARRAY_BUFFER, std::span<const Line>(line_vertices_));
    // OpenGL measures a line's width along one axis of the screen, so a diagonal line is thinner, by a factor of up to
    // sqrt(2).
    glLineWidth((width + 1.0f) * std::numbers::sqrt2_v<float>);
    draw_occluded_and_visible(line_program_, occluded_alpha, [&] { glDrawArrays(GL_LINES, 0, 2 * count); });
  } else {
    line_buffer_.stream(GL_ARRAY_BUFFER, lines);
    draw_occluded_and_visible(line_program_, occluded_alpha,
                              [&] { glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count); });
  }
}

void OverlayPass::draw_points(const PointSet& set, float scale) {
  if (set.points.empty()) return;
  point_buffer_.stream(GL_ARRAY_BUFFER, std::span(set.points));
  point_program_.use();
  point_program_.set("diameter", set.diameter * scale);
  point_array_.bind();
  const auto count = static_cast<GLsizei>(set.points.size());
  draw_occluded_and_visible(point_program_, set.occluded_alpha,
                            [&] { glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count); });
}

/// Draws faintly where a solid is in front, then in full where none is. By the stencil, each pixel is drawn faintly at
/// most once: else many points in one place would look as if they were in front.
template <class Draw>
void OverlayPass::draw_occluded_and_visible(const Program& program, float occluded_alpha, const Draw& draw) {
  const auto draw_where = [&](GLenum depth_test, float opacity) {
    glDepthFunc(depth_test);
    program.set("opacity", opacity);
    draw();
  };
  if (occluded_alpha > 0.0f) {
    faint_set_ = faint_set_ % int{stencil_overlays} + 1;
    glEnable(GL_STENCIL_TEST);
    glStencilMask(stencil_overlays);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    glStencilFunc(GL_NOTEQUAL, faint_set_, stencil_overlays);
    draw_where(GL_GREATER, occluded_alpha);
    glStencilMask(0xff);
    glDisable(GL_STENCIL_TEST);
  }
  draw_where(GL_LEQUAL, 1.0f);
}

void OverlayPass::draw_faces(const BoxSet& set) {
  if (set.face_alpha <= 0.0f) return;
  box_buffer_.stream(GL_ARRAY_BUFFER, std::span(set.boxes));
  glDepthFunc(GL_LEQUAL);
  box_program_.use();
  box_program_.set("opacity", set.face_alpha);
  box_array_.bind();
  glEnable(GL_CULL_FACE);  // halves the pixels; the front faces alone tint the content of a box well enough
  glDrawArraysInstanced(GL_TRIANGLES, 0, 36, static_cast<GLsizei>(set.boxes.size()));
  glDisable(GL_CULL_FACE);
}

}  // namespace engine::render
