#include "engine/render/overlays.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <tuple>

#include "engine/context.h"

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

/// An edge along an axis, from `lo` to `hi` on it; `at` on the two axes after it.
struct Edge {
  int axis;
  std::array<float, 2> at;
  float lo, hi;
  glm::vec4 colour;

  bool on_line_of(const Edge& other) const { return axis == other.axis && at == other.at; }
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

/// The edges of all boxes. Neighbours share theirs: one is enough, and what goes on in a line is one line. That leaves
/// a third of those of a grid.
std::vector<Line> edges_of(const std::vector<Box>& boxes) {
  std::vector<Edge> edges;
  edges.reserve(12 * boxes.size());
  for (const Box& box : boxes) append_edges(edges, box);
  std::ranges::stable_sort(edges, {}, [](const Edge& e) { return std::tuple(e.axis, e.at, e.lo, e.hi); });
  std::vector<Edge> merged;
  for (const Edge& edge : edges) {
    Edge* last = merged.empty() || !merged.back().on_line_of(edge) ? nullptr : &merged.back();
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

}  // namespace

Overlays::Overlays(const std::filesystem::path& shaders)
    : axes_alone_(draws_in_software()),
      line_program_(shaders, "line.vert", "line.frag"),
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
  if (!axes_alone_) return;
  line_array_.bind();
  for (GLuint attribute = 0; attribute < 3; ++attribute) glVertexAttribDivisor(attribute, 0);
}

void Overlays::draw(const FrameData& frame) {
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  for (const BoxSet& set : frame.boxes) {
    if (set.boxes.empty()) continue;
    draw_faces(set);
    draw_lines(edges_of(set.boxes), set.width * frame.pixel_scale, set.hidden);
  }
  for (const LineSet& set : frame.lines) draw_lines(set.lines, set.width * frame.pixel_scale, set.hidden);
  for (const PointSet& set : frame.points) draw_points(set, frame.pixel_scale);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

void Overlays::draw_lines(std::span<const Line> lines, float width, float hidden) {
  if (lines.empty()) return;
  line_program_.use();
  line_program_.set("width", width);
  line_program_.set("sides", axes_alone_ ? 0.0f : 1.0f);
  line_array_.bind();
  const auto count = static_cast<GLsizei>(lines.size());
  if (axes_alone_) {
    ends_.clear();
    for (const Line& line : lines) ends_.insert(ends_.end(), 2, line);
    line_buffer_.stream(GL_ARRAY_BUFFER, std::span<const Line>(ends_));
    // A line's width is counted along one axis of the screen, which is least across a diagonal.
    glLineWidth((width + 1.0f) * std::numbers::sqrt2_v<float>);
    draw_twice(line_program_, hidden, [&] { glDrawArrays(GL_LINES, 0, 2 * count); });
  } else {
    line_buffer_.stream(GL_ARRAY_BUFFER, lines);
    draw_twice(line_program_, hidden, [&] { glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count); });
  }
}

void Overlays::draw_points(const PointSet& set, float scale) {
  if (set.points.empty()) return;
  point_buffer_.stream(GL_ARRAY_BUFFER, std::span(set.points));
  point_program_.use();
  point_program_.set("diameter", set.diameter * scale);
  point_array_.bind();
  const auto count = static_cast<GLsizei>(set.points.size());
  draw_twice(point_program_, set.hidden, [&] { glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count); });
}

/// Faint where something is in front, then in full where nothing is.
template <class Draw>
void Overlays::draw_twice(const Program& program, float hidden, const Draw& draw) {
  const auto pass = [&](GLenum depth_test, float opacity) {
    glDepthFunc(depth_test);
    program.set("opacity", opacity);
    draw();
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
  glEnable(GL_CULL_FACE);  // half the pixels: the near faces tint what is in a box well enough
  glDrawArraysInstanced(GL_TRIANGLES, 0, 36, static_cast<GLsizei>(set.boxes.size()));
  glDisable(GL_CULL_FACE);
}

}  // namespace engine
