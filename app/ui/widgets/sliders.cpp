// The widgets for numbers that the user drags or types.

#include <fmt/core.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <type_traits>

#include "app/base/parse_numbers.h"
#include "app/ui/widgets/widgets.h"

namespace app::ui {

void Widgets::register_number(std::string_view label, std::string_view tooltip) {
  // In an open field ImGui selects a word at a double-click. Newer versions end a word at the decimal point.
  if (ImGuiInputTextState* field = ImGui::GetInputTextState(ImGui::GetActiveID());
      field && ImGui::IsItemActive() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
    field->SelectAll();
    field->SelectedAllMouseLock = true;  // until the button is up
  }
  constexpr const char* how = "Drag it sideways, or double-click it to type a value.";
  register_item(label, fmt::format("{}\n{}", tooltip, how));
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

template <class Value>
constexpr ImGuiDataType imgui_type = std::is_same_v<Value, float> ? ImGuiDataType_Float
                                     : std::is_signed_v<Value>    ? ImGuiDataType_S32
                                                                  : ImGuiDataType_U32;

std::string id_of(std::string_view label) { return fmt::format("##{}", label); }

/// Returns the value as a field for typing shows it: without what stands round the number in `format`.
template <class Value>
std::string field_text(Value value, const char* format) {
  std::array<char, 64> number_format{}, text{};
  const char* trimmed = ImParseFormatTrimDecorations(format, number_format.data(), number_format.size());
  ImGui::DataTypeFormatString(text.data(), static_cast<int>(text.size()), imgui_type<Value>, &value, trimmed);
  ImStrTrimBlanks(text.data());
  return text.data();
}

}  // namespace

template <class Value>
bool Widgets::type(const Number<Value>& n) {
  const std::string shown = field_text(n.value, n.format);
  std::array<char, 1024> typed{};
  shown.copy(typed.data(), typed.size() - 1);
  const bool edited =
      ImGui::InputText(id_of(n.label).c_str(), typed.data(), typed.size(), ImGuiInputTextFlags_AutoSelectAll);
  const ImGuiID id = ImGui::GetItemID();
  if (ImGui::IsItemActivated()) open_field(id, n.value);
  if (!edited) return false;
  if (input_.field != id) open_field(id, n.value);
  const Value before = n.value, kept = static_cast<Value>(input_.field_value);
  const std::string kept_text = field_text(kept, n.format), text = typed.data();
  input_.field_problem.emplace();
  const auto number = parse_typed(text, std::is_integral_v<Value>);
  if (text == kept_text) {  // the value itself may have more digits
    n.value = kept;
  } else if (number) {
    const double nearest = std::clamp(*number, static_cast<double>(n.min), static_cast<double>(n.max));
    n.value = static_cast<Value>(nearest);
    if (std::abs(*number - nearest) > std::abs(nearest) * static_cast<double>(std::numeric_limits<Value>::epsilon()))
      input_.field_problem = fmt::format("{}: {:.40} is outside {} to {} and becomes {}", n.label, text, n.min, n.max,
                                         field_text(n.value, n.format));
  } else {
    n.value = kept;
    input_.field_problem = fmt::format("{}: \"{:.40}\" is not a {}; the value stays {}", n.label, text,
                                       std::is_integral_v<Value> ? "whole number" : "number", kept_text);
  }
  return n.value != before;
}

template <class Value, class Show>
bool Widgets::drag_or_type(const Number<Value>& n, const Show& show) {
  const std::string name = id_of(n.label);
  const ImGuiID id = ImGui::GetID(name.c_str());
  if (ImGui::TempInputIsActive(id)) return type(n);
  const bool changed = show(name.c_str());
  if (ImGui::TempInputIsActive(id)) open_field(id, n.value);
  return changed;
}

template <class Value>
bool Widgets::slider(std::string_view label, Value& value, std::type_identity_t<Value> min,
                     std::type_identity_t<Value> max, const char* format, std::string_view tooltip, bool logarithmic) {
  assert(min > 0 || !logarithmic || !std::is_integral_v<Value>);
  const Number<Value> n{label, value, min, max, format};
  const Value now = value;
  const bool double_clicked = opens_field() && input_.pressed == label;
  if (double_clicked) value = static_cast<Value>(input_.value_before);
  const bool changed = [&] {
    const HiddenGrab hide;
    const OpenByDoubleClick opens;
    return drag_or_type(n, [&](const char* id) {
      return ImGui::SliderScalar(id, imgui_type<Value>, &value, &min, &max, format,
                                 clamped | (logarithmic ? ImGuiSliderFlags_Logarithmic : 0));
    });
  }();
  if (double_clicked) {
    if (!ImGui::IsItemActive()) value = now;  // the second click missed the slider
    input_.pressed.clear();
  } else if (ImGui::IsItemActivated()) {
    input_.pressed = label;
    input_.value_before = static_cast<double>(now);
  }
  const auto first = static_cast<double>(min), last = static_cast<double>(max);
  // A logarithmic slider from 0 begins at the smallest number that ImGui shows.
  const double begin = logarithmic ? std::max(first, std::pow(0.1, ImParseFormatPrecision(n.format, 3))) : first;
  const double steps = std::is_integral_v<Value> && !logarithmic ? last - first : 0;
  draw_grab(relative_position(static_cast<double>(value), begin, last, logarithmic), static_cast<float>(steps),
            px(slider_bar));
  register_number(label, tooltip);
  return changed || value != now;
}
template bool Widgets::slider(std::string_view, int&, int, int, const char*, std::string_view, bool);
template bool Widgets::slider(std::string_view, float&, float, float, const char*, std::string_view, bool);
template bool Widgets::slider(std::string_view, std::uint32_t&, std::uint32_t, std::uint32_t, const char*,
                              std::string_view, bool);

bool Widgets::slider(std::string_view label, double& value, double min, double max, const char* format,
                     std::string_view tooltip, bool logarithmic) {
  auto shown = static_cast<float>(value);
  const bool changed =
      slider(label, shown, static_cast<float>(min), static_cast<float>(max), format, tooltip, logarithmic);
  if (changed) value = static_cast<double>(shown);
  return changed;
}

bool Widgets::drag(std::string_view label, glm::dvec3& value, float min, float max, std::string_view tooltip) {
  constexpr float metres_per_pixel = 0.01f;
  bool changed = false;
  ImGui::BeginGroup();
  ImGui::PushMultiItemsWidths(3, ImGui::CalcItemWidth());
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    if (axis > 0) ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    const std::string name = fmt::format("{}, {}", label, "xyz"[axis]);
    auto shown = static_cast<float>(value[axis]);
    const Number<float> number{name, shown, min, max, "%.2f"};
    if (drag_or_type(number, [&](const char* id) {
          return ImGui::DragFloat(id, &shown, metres_per_pixel, min, max, number.format, clamped);
        })) {
      value[axis] = static_cast<double>(shown);
      changed = true;
    }
    ImGui::PopItemWidth();
  }
  ImGui::EndGroup();
  register_number(label, tooltip);
  return changed;
}

bool Widgets::number_field(std::string_view label, std::uint32_t& value, std::uint32_t min, std::uint32_t max,
                           std::string_view tooltip) {
  value = std::clamp(value, min, max);
  return register_item(type<std::uint32_t>({label, value, min, max, "%u"}), label, tooltip);
}

}  // namespace app::ui
