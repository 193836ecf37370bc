// The widgets of numbers that are dragged.

#include <fmt/core.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/ui/widgets/widgets.h"

namespace app {

void Widgets::done_with_number(const char* label, const char* tooltip) {
  // By a double-click, an open field selects a word, which of a number is all or, in newer versions, ends at its point.
  if (ImGuiInputTextState* field = ImGui::GetInputTextState(ImGui::GetActiveID());
      field && ImGui::IsItemActive() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
    field->SelectAll();
    field->SelectedAllMouseLock = true;  // until the button is up
  }
  constexpr const char* how = "Drag it sideways, or double-click it to type a value.";
  done(label, tooltip ? fmt::format("{}\n{}", tooltip, how).c_str() : how);
}

namespace {

/// Sliders write their value in the middle, where ImGui's own grab would stand in its way.
class HiddenGrab {
 public:
  HiddenGrab() {
    for (const ImGuiCol which : {ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive}) ImGui::PushStyleColor(which, {});
  }
  ~HiddenGrab() { ImGui::PopStyleColor(2); }
};

/// How far a value is between the ends of a slider, 0 .. 1.
float place_of(double value, double least, double most, bool logarithmic) {
  const double place =
      logarithmic ? std::log(value / least) / std::log(most / least) : (value - least) / (most - least);
  return static_cast<float>(std::clamp(place, 0.0, 1.0));
}

/// A bar and a grab along the lower edge of the last item, below its text. steps: of whole numbers; 0: no steps.
void mark_slider(float place, float steps, float bar) {
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  constexpr float border = 2;  // where ImGui's grab ends
  const float room = max.x - min.x - 2 * border;
  const float grab = std::min(room, std::max(ImGui::GetStyle().GrabMinSize, steps > 0 ? room / (steps + 1) : 0));
  const float left = min.x + border + place * (room - grab);
  const ImU32 colour = ImGui::GetColorU32(ImGui::IsItemActive() ? ImGuiCol_SliderGrabActive : ImGuiCol_SliderGrab);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled({min.x + border, max.y - bar}, {left, max.y}, ImGui::GetColorU32(ImGuiCol_SliderGrab, 0.35f));
  draw->AddRectFilled({left, max.y - 2 * bar}, {left + grab, max.y}, colour, bar);
}

constexpr float slider_bar = 2.5f;  // design pixels
constexpr ImGuiSliderFlags kept_inside = ImGuiSliderFlags_AlwaysClamp;

/// By double-click. One in a field that is open already selects a word there.
bool opens_field() { return ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && !ImGui::IsAnyItemActive(); }

/// ImGui's sliders open a field for typing by Ctrl+click alone, its drags by double-click too.
struct OpensByDoubleClick {
  const bool before = ImGui::GetIO().KeyCtrl;
  OpensByDoubleClick() { ImGui::GetIO().KeyCtrl |= opens_field(); }
  ~OpensByDoubleClick() { ImGui::GetIO().KeyCtrl = before; }
};

}  // namespace

template <class Value, class Show>
bool Widgets::slide(const char* label, Value& value, const Show& show) {
  const Value now = value;
  const bool twice = opens_field() && hover_.pressed == label;
  if (twice) value = static_cast<Value>(hover_.before);
  const bool changed = [&] {
    const HiddenGrab hide;
    const OpensByDoubleClick opens;
    return show(twice);
  }();
  if (twice) {
    if (!ImGui::IsItemActive()) value = now;  // the second click was beside it
    hover_.pressed.clear();
  } else if (ImGui::IsItemActivated()) {
    hover_.pressed = label;
    hover_.before = static_cast<double>(now);
  }
  return changed || value != now;
}

bool Widgets::slider(const char* label, int& value, int least, int most, const char* format, const char* tooltip) {
  const bool changed = slide(label, value, [&](bool) {
    return ImGui::SliderInt(fmt::format("##{}", label).c_str(), &value, least, most, format, kept_inside);
  });
  mark_slider(place_of(value, least, most, false), static_cast<float>(most - least), px(slider_bar));
  done_with_number(label, tooltip);
  return changed;
}

bool Widgets::slider(const char* label, float& value, float least, float most, const char* format, const char* tooltip,
                     bool logarithmic) {
  const ImGuiSliderFlags flags = kept_inside | (logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
  const bool changed = slide(label, value, [&](bool) {
    return ImGui::SliderFloat(fmt::format("##{}", label).c_str(), &value, least, most, format, flags);
  });
  // ImGui's logarithmic sliders begin where the shown digits do, if at 0.
  const double begin = logarithmic ? std::max(double{least}, std::pow(0.1, ImParseFormatPrecision(format, 3))) : least;
  mark_slider(place_of(double{value}, begin, double{most}, logarithmic), 0, px(slider_bar));
  done_with_number(label, tooltip);
  return changed;
}

bool Widgets::slider(const char* label, std::uint32_t& value, std::uint32_t least, std::uint32_t most,
                     const char* tooltip) {
  const bool changed = slide(label, value, [&](bool typed) {
    return ImGui::SliderScalar(fmt::format("##{}", label).c_str(), ImGuiDataType_U32, &value, &least, &most,
                               typed ? "%u" : "", kept_inside | ImGuiSliderFlags_Logarithmic);
  });
  mark_slider(place_of(value, least, most, true), 0, px(slider_bar));
  done_with_number(label, tooltip);
  return changed;
}

bool Widgets::drag(const char* label, glm::dvec3& value, float least, float most, const char* tooltip) {
  constexpr float metres_a_pixel = 0.01f;
  std::array<float, 3> shown{static_cast<float>(value.x), static_cast<float>(value.y), static_cast<float>(value.z)};
  const bool changed = ImGui::DragFloat3(fmt::format("##{}", label).c_str(), shown.data(), metres_a_pixel, least, most,
                                         "%.2f", kept_inside);
  done_with_number(label, tooltip);
  const bool usable = changed && std::ranges::all_of(shown, [](float v) { return std::isfinite(v); });
  if (usable) value = {shown[0], shown[1], shown[2]};
  return usable;
}

}  // namespace app
