#include "engine/render/overlays.h"

#include <cstddef>

namespace engine {
namespace {

/// Describes `Item` to the bound vertex array: `vectors` three-float attributes, then a colour.
void describe(GLuint vectors, std::size_t item_size) {
  for (GLuint attribute = 0; attribute <= vectors; ++attribute) {
    const auto at = reinterpret_cast<const void*>(attribute * sizeof(glm::vec3));
    glVertexAttribPointer(attribute, attribute < vectors ? 3 : 4, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(item_size),
                          at);
    glVertexAttribDivisor(attribute, 1);
    glEnableVertexAttribArray(attribute);
  }
}

static_assert(sizeof(Line) == 40 && offsetof(Line, colour) == 24);
static_assert(sizeof(Box) == 40 && offsetof(Box, colour) == 24);
static_assert(sizeof(Point) == 28 && offsetof(Point, colour) == 12);

void append_edges(std::vector<Line>& edges, const Box& box) {
  const auto corner = [&](unsigned i) {
    return glm::vec3((i & 1) ? box.hi.x : box.lo.x, (i & 2) ? box.hi.y : box.lo.y, (i & 4) ? box.hi.z : box.lo.z);
  };
  for (unsigned i = 0; i < 8; ++i) {
    for (unsigned axis = 1; axis < 8; axis <<= 1) {
      if ((i & axis) == 0) edges.push_back({corner(i), corner(i | axis), box.colour});
    }
  }
}

}  // namespace

Overlays::Overlays(const std::filesystem::path& shaders)
    : line_program_(shaders, "line.vert", "line.frag"),
      point_program_(shaders, "point.vert", "point.frag"),
      box_program_(shaders, "box.vert", "box.frag") {
  const auto set_up = [](const VertexArray& array, const Buffer& buffer, GLuint vectors, std::size_t item_size) {
    array.bind();
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    describe(vectors, item_size);
  };
  set_up(line_array_, line_buffer_, 2, sizeof(Line));
  set_up(point_array_, point_buffer_, 1, sizeof(Point));
  set_up(box_array_, box_buffer_, 2, sizeof(Box));
}

void Overlays::draw(const FrameData& frame) {
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  for (const BoxSet& set : frame.boxes) {
    if (set.boxes.empty()) continue;
    draw_faces(set);
    edges_.clear();
    for (const Box& box : set.boxes) append_edges(edges_, box);
    draw_lines(edges_, set.width * frame.pixel_scale, set.hidden);
  }
  for (const LineSet& set : frame.lines) draw_lines(set.lines, set.width * frame.pixel_scale, set.hidden);
  for (const PointSet& set : frame.points) draw_points(set, frame.pixel_scale);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

void Overlays::draw_lines(std::span<const Line> lines, float width, float hidden) {
  if (lines.empty()) return;
  line_buffer_.stream(GL_ARRAY_BUFFER, lines);
  line_program_.use();
  line_program_.set("width", width);
  draw_items(line_program_, line_array_, lines.size(), hidden);
}

void Overlays::draw_points(const PointSet& set, float scale) {
  if (set.points.empty()) return;
  point_buffer_.stream(GL_ARRAY_BUFFER, std::span(set.points));
  point_program_.use();
  point_program_.set("diameter", set.diameter * scale);
  draw_items(point_program_, point_array_, set.points.size(), set.hidden);
}

void Overlays::draw_items(const Program& program, const VertexArray& array, std::size_t count, float hidden) {
  array.bind();
  const auto pass = [&](GLenum depth_test, float opacity) {
    glDepthFunc(depth_test);
    program.set("opacity", opacity);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count));
  };
  if (hidden > 0.0f) pass(GL_GREATER, hidden);
  pass(GL_LEQUAL, 1.0f);
}

void Overlays::draw_faces(const BoxSet& set) {
  if (set.fill <= 0.0f) return;
  box_buffer_.stream(GL_ARRAY_BUFFER, std::span(set.boxes));
  glDepthFunc(GL_LEQUAL);
  box_program_.use();
  box_program_.set("opacity", set.fill);
  box_array_.bind();
  glDrawArraysInstanced(GL_TRIANGLES, 0, 36, static_cast<GLsizei>(set.boxes.size()));
}

}  // namespace engine
