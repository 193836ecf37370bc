// The widgets for numbers that the user drags.

#include <fmt/core.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "app/ui/widgets/widgets.h"

namespace app::ui {

void Widgets::register_number(const char* label, const char* tooltip) {
  // In an open field ImGui selects a word at a double-click. Newer versions end a word at the decimal point.
  if (ImGuiInputTextState* field = ImGui::GetInputTextState(ImGui::GetActiveID());
      field && ImGui::IsItemActive() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
    field->SelectAll();
    field->SelectedAllMouseLock = true;  // until the button is up
  }
  constexpr const char* how = "Drag it sideways, or double-click it to type a value.";
  register_item(label, tooltip ? fmt::format("{}\n{}", tooltip, how).c_str() : how);
}

namespace {

/// Hides ImGui's own grab, which would cover the value in the middle of the slider.
class HiddenGrab {
 public:
  HiddenGrab() {
    for (const ImGuiCol which : {ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive}) ImGui::PushStyleColor(which, {});
  }
  ~HiddenGrab() { ImGui::PopStyleColor(2); }
};

/// Returns the position of a value between the ends of a slider, 0 .. 1.
float relative_position(double value, double min, double max, bool logarithmic) {
  const double position = logarithmic ? std::log(value / min) / std::log(max / min) : (value - min) / (max - min);
  return static_cast<float>(std::clamp(position, 0.0, 1.0));
}

/// Draws a bar and a grab along the lower edge of the last item, below its text. `steps`: between whole numbers; 0: the
/// slider has no steps.
void draw_grab(float position, float steps, float bar) {
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  constexpr float border = 2;  // as that of ImGui's grab
  const float room = max.x - min.x - 2 * border;
  const float grab = std::min(room, std::max(ImGui::GetStyle().GrabMinSize, steps > 0 ? room / (steps + 1) : 0));
  const float left = min.x + border + position * (room - grab);
  const ImU32 colour = ImGui::GetColorU32(ImGui::IsItemActive() ? ImGuiCol_SliderGrabActive : ImGuiCol_SliderGrab);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled({min.x + border, max.y - bar}, {left, max.y}, ImGui::GetColorU32(ImGuiCol_SliderGrab, 0.35f));
  draw->AddRectFilled({left, max.y - 2 * bar}, {left + grab, max.y}, colour, bar);
}

constexpr float slider_bar = 2.5f;  // design pixels
constexpr ImGuiSliderFlags clamped = ImGuiSliderFlags_AlwaysClamp;

/// True at a double-click, unless a field is open already: there a double-click selects a word.
bool opens_field() { return ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && !ImGui::IsAnyItemActive(); }

/// Lets a double-click open a slider's field for typing. ImGui opens it only by Ctrl+click.
struct OpenByDoubleClick {
  const bool before = ImGui::GetIO().KeyCtrl;
  OpenByDoubleClick() { ImGui::GetIO().KeyCtrl |= opens_field(); }
  ~OpenByDoubleClick() { ImGui::GetIO().KeyCtrl = before; }
};

}  // namespace

template <class Value, class Show>
bool Widgets::slide(const char* label, Value& value, const Show& show) {
  const Value now = value;
  const bool double_clicked = opens_field() && mouse_.pressed == label;
  if (double_clicked) value = static_cast<Value>(mouse_.value_before);
  const bool changed = [&] {
    const HiddenGrab hide;
    const OpenByDoubleClick opens;
    return show(double_clicked);
  }();
  if (double_clicked) {
    if (!ImGui::IsItemActive()) value = now;  // the second click missed the slider
    mouse_.pressed.clear();
  } else if (ImGui::IsItemActivated()) {
    mouse_.pressed = label;
    mouse_.value_before = static_cast<double>(now);
  }
  return changed || value != now;
}

bool Widgets::slider(const char* label, int& value, int min, int max, const char* format, const char* tooltip) {
  const bool changed = slide(label, value, [&](bool) {
    return ImGui::SliderInt(fmt::format("##{}", label).c_str(), &value, min, max, format, clamped);
  });
  draw_grab(relative_position(value, min, max, false), static_cast<float>(max - min), px(slider_bar));
  register_number(label, tooltip);
  return changed;
}

bool Widgets::slider(const char* label, float& value, float min, float max, const char* format, const char* tooltip,
                     bool logarithmic) {
  const ImGuiSliderFlags flags = clamped | (logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
  const bool changed = slide(label, value, [&](bool) {
    return ImGui::SliderFloat(fmt::format("##{}", label).c_str(), &value, min, max, format, flags);
  });
  // A logarithmic slider from 0 begins at the smallest number that ImGui shows.
  const double begin = logarithmic ? std::max(double{min}, std::pow(0.1, ImParseFormatPrecision(format, 3))) : min;
  draw_grab(relative_position(double{value}, begin, double{max}, logarithmic), 0, px(slider_bar));
  register_number(label, tooltip);
  return changed;
}

bool Widgets::slider(const char* label, std::uint32_t& value, std::uint32_t min, std::uint32_t max,
                     const char* tooltip) {
  assert(min > 0);
  const bool changed = slide(label, value, [&](bool typed) {
    return ImGui::SliderScalar(fmt::format("##{}", label).c_str(), ImGuiDataType_U32, &value, &min, &max,
                               typed ? "%u" : "", clamped | ImGuiSliderFlags_Logarithmic);
  });
  draw_grab(relative_position(value, min, max, true), 0, px(slider_bar));
  register_number(label, tooltip);
  return changed;
}

bool Widgets::drag(const char* label, glm::dvec3& value, float min, float max, const char* tooltip) {
  constexpr float metres_per_pixel = 0.01f;
  std::array<float, 3> shown{static_cast<float>(value.x), static_cast<float>(value.y), static_cast<float>(value.z)};
  const bool changed =
      ImGui::DragFloat3(fmt::format("##{}", label).c_str(), shown.data(), metres_per_pixel, min, max, "%.2f", clamped);
  register_number(label, tooltip);
  const bool usable = changed && std::ranges::all_of(shown, [](float v) { return std::isfinite(v); });
  if (usable) value = {shown[0], shown[1], shown[2]};
  return usable;
}

}  // namespace app::ui
