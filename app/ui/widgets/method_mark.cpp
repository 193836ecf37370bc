#include "app/ui/widgets/method_mark.h"

#include <array>
#include <cmath>
#include <numbers>

namespace app::ui {
namespace {

constexpr int max_corners = 20;

/// A polygon, or a cross of strokes through its corners.
struct Shape {
  enum Style { strokes, outline, filled } style;
  int corners;
  float first;       // the direction of the first corner in turns, clockwise from the right
  float radius = 1;  // so that all marks look equally large
};

Shape shape_of(collide::Marker marker) {
  using enum collide::Marker;
  constexpr float upwards = 0.75f, downwards = 0.25f;
  switch (marker) {
    case plus:
      return {Shape::strokes, 4, 0, 1.1f};
    case cross:
      return {Shape::strokes, 4, 0.125f, 1.1f};
    case square:
      return {Shape::outline, 4, 0.125f, 1.15f};
    case filled_square:
      return {Shape::filled, 4, 0.125f, 1.25f};
    case circle:
      return {Shape::outline, max_corners, 0, 0.9f};
    case disc:
      return {Shape::filled, max_corners, 0};
    case triangle:
      return {Shape::outline, 3, upwards, 1.15f};
    case filled_triangle:
      return {Shape::filled, 3, upwards, 1.3f};
    case filled_inverted_triangle:
      return {Shape::filled, 3, downwards, 1.3f};
    case diamond:
      return {Shape::outline, 4, 0, 1.1f};
    case filled_diamond:
      return {Shape::filled, 4, 0, 1.2f};
    case filled_pentagon:
      return {Shape::filled, 5, upwards, 1.1f};
  }
  return {Shape::filled, max_corners, 0};
}

}  // namespace

void draw_marker(ImVec2 at, float radius, collide::Marker marker, ImU32 colour, float line) {
  const Shape shape = shape_of(marker);
  std::array<ImVec2, max_corners> corners;
  for (int i = 0; i < shape.corners; ++i) {
    const float turn = shape.first + static_cast<float>(i) / static_cast<float>(shape.corners);
    const float angle = 2 * std::numbers::pi_v<float> * turn;
    corners[static_cast<std::size_t>(i)] = {at.x + radius * shape.radius * std::cos(angle),
                                            at.y + radius * shape.radius * std::sin(angle)};
  }
  ImDrawList* draw = ImGui::GetWindowDrawList();
  switch (shape.style) {
    case Shape::strokes:
      draw->AddLine(corners[0], corners[2], colour, line);
      draw->AddLine(corners[1], corners[3], colour, line);
      break;
    case Shape::outline:
      draw->AddPolyline(corners.data(), shape.corners, colour, ImDrawFlags_Closed, line);
      break;
    case Shape::filled:
      draw->AddConvexPolyFilled(corners.data(), shape.corners, colour);
      break;
  }
}

void draw_method_mark(const Widgets& w, const collide::Method& method, float line_height) {
  const float radius = 0.34f * ImGui::GetFontSize();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  draw_marker({at.x + radius, at.y + 0.5f * line_height}, radius, method.marker, to_imgui(method.colour), w.px(1.8f));
  ImGui::Dummy({2 * radius, line_height});
}

}  // namespace app::ui
