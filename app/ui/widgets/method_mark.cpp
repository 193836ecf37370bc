#include "app/ui/widgets/method_mark.h"

#include <array>
#include <cmath>
#include <numbers>

namespace app::ui {
namespace {

constexpr int max_corners = 20;

/// A polygon, or strokes through its corners.
struct Shape {
  enum Style { strokes, outline, filled } style;
  int corners;
  float first;       // the direction of the first corner in turns, clockwise from the right
  float radius = 1;  // so that all marks look equally large
};

constexpr float up = 0.75f, down = 0.25f;
constexpr std::array<Shape, 15> shapes{{
    {Shape::strokes, 4, 0, 1.1f},            // plus
    {Shape::strokes, 4, 0.125f, 1.1f},       // cross
    {Shape::strokes, 8, 0, 1.1f},            // star
    {Shape::outline, 4, 0.125f, 1.15f},      // square
    {Shape::filled, 4, 0.125f, 1.25f},       // filled square
    {Shape::outline, max_corners, 0, 0.9f},  // circle
    {Shape::filled, max_corners, 0},         // disc
    {Shape::outline, 3, up, 1.15f},          // triangle
    {Shape::filled, 3, up, 1.3f},            // filled triangle
    {Shape::outline, 3, down, 1.15f},        // inverted triangle
    {Shape::filled, 3, down, 1.3f},          // filled inverted triangle
    {Shape::outline, 4, 0, 1.1f},            // diamond
    {Shape::filled, 4, 0, 1.2f},             // filled diamond
    {Shape::outline, 5, up},                 // pentagon
    {Shape::filled, 5, up, 1.1f},            // filled pentagon
}};

}  // namespace

void draw_marker(ImVec2 at, float radius, compare::Marker marker, ImU32 colour, float line) {
  const Shape& shape = shapes[static_cast<std::size_t>(marker) - 1];
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
      for (std::size_t i = 0, half = static_cast<std::size_t>(shape.corners) / 2; i < half; ++i)
        draw->AddLine(corners[i], corners[i + half], colour, line);
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
  const compare::MethodStyle style = compare::style(method);
  draw_marker({at.x + radius, at.y + 0.5f * line_height}, radius, style.marker, to_imgui(style.colour), w.px(1.8f));
  ImGui::Dummy({2 * radius, line_height});
}

}  // namespace app::ui
