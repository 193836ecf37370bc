#pragma once
// A thin layer over Dear ImGui: every widget has a tooltip and, in tests, records its label and rectangle.

#include <imgui.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <glm/vec3.hpp>

#include "app/base/text.h"
#include "app/base/time_series.h"
#include "app/ui/state/requests.h"

namespace app::ui {

/// The widgets of the last frame. Tests install it to find where to click.
struct WidgetRecorder {
  struct Widget {
    std::string label;
    ImVec2 min, max;
    bool enabled;
  };
  std::vector<Widget> widgets;
  std::string tooltip;  // the text of the one that is shown

  const Widget* find(std::string_view label) const;
};

/// A part of the display, in ImGui units.
struct ScreenRect {
  ImVec2 min, max;
};
inline bool overlap(const ScreenRect& a, const ScreenRect& b) {
  return a.min.x < b.max.x && b.min.x < a.max.x && a.min.y < b.max.y && b.min.y < a.max.y;
}

/// Greys out, while it lives, the items that are drawn, and keeps the mouse from them: if `off`.
struct Disabled {
  explicit Disabled(bool off) { ImGui::BeginDisabled(off); }
  Disabled(const Disabled&) = delete;
  Disabled& operator=(const Disabled&) = delete;
  ~Disabled() { ImGui::EndDisabled(); }
};

/// What the mouse does, where tooltips may stand, and what is typed into a field, from frame to frame.
struct InputState {
  static constexpr float tooltip_delay = 0.4f;  // s
  /// Begins a frame.
  void update(float min_move);
  /// Shows no tooltip until the mouse leaves this place.
  void wait_for_mouse(const ImVec2& at) { clicked = true, clicked_at = at; }

  bool clicked = false;                           // a button is down, or the mouse has not moved since one was
  ImVec2 clicked_at{};                            // where the mouse was then
  std::vector<ScreenRect> results, last_results;  // what tooltips keep off: in this frame, and in the one before
  // The widget under the mouse, and how long the mouse has rested on it.
  std::string hovered;
  float seconds = 0;
  // The slider pressed last, and its value before, which a double-click restores.
  std::string pressed;
  double value_before = 0;
  // The number field opened last, and its value then, which stays if the text is no number.
  ImGuiID field = 0;
  double field_value = 0;
  std::optional<std::string> field_problem;  // of the text typed in this frame, empty if it is the value
};

/// Width of the labels in the rows of settings, in design pixels.
inline constexpr float label_column = 108;

ImU32 to_imgui(const glm::vec3& colour, float alpha = 1.0f);

/// Draws a colour scale in `steps` steps, whose colours colour(0 .. 1) returns. `min`: the upper left corner; `bottom`:
/// the lower end (y).
void draw_colour_scale(ImVec2 min, float width, float bottom, int steps, glm::vec3 (*colour)(float));

/// Returns the text with line ends in place of spaces, so that no line is wider than `width` (ImGui units), except one
/// word that is wider alone. ImGui by itself breaks lines within numbers, too. A number keeps its unit.
std::string wrapped(std::string_view text, float width);

/// Returns the first of 1, 2, 5, 10, ... times `min_end` that is not below `max`, so that an axis rarely changes.
/// min_end > 0.
float axis_end(float max, float min_end);

struct Axis {
  float bottom, top;
};
/// Returns an axis around all values of a series, at least `min_length` long (> 0). It rarely changes.
Axis axis_around(const TimeSeries& series, float min_length);

/// The widgets of one frame, and what the user asks for by them. Labels are unique; they are ImGui's identifiers too.
class Widgets {
 public:
  /// `sections`: UiState::sections, which are open.
  Widgets(float scale, InputState& input, const std::map<std::string, bool>& sections, Requests& requests,
          WidgetRecorder* recorder = nullptr)
      : scale_(scale),
        usual_alpha_(ImGui::GetStyle().Alpha),
        input_(input),
        sections_(sections),
        requests_(requests),
        recorder_(recorder) {
    input_.update(px(3));
  }

  /// Asks for what is to be carried out after the drawing, as app::ui::ask() does.
  void ask(const auto& asked) { ui::ask(requests_, asked); }

  /// Converts design pixels to ImGui units.
  float px(float design) const { return design * scale_; }

  bool button(std::string_view label, std::string_view tooltip, float width = 0, bool enabled = true);
  /// Returns true if the value should be the other one.
  bool checkbox(std::string_view label, bool value, std::string_view tooltip);
  /// Draws a title with a close button, whose label is "Close " and the title's identifier. True if it is clicked.
  bool closable_heading(std::string_view label, std::string_view tooltip);
  /// Draws the heading of a section that folds, closed at first. True if it is open.
  bool section(std::string_view label);
  /// Draws a slider for an int, a float, a std::uint32_t or a double. A double-click opens a field for typing.
  /// Precondition of a logarithmic slider for whole numbers: min > 0.
  template <class Value>
  bool slider(std::string_view label, Value& value, std::type_identity_t<Value> min, std::type_identity_t<Value> max,
              const char* format, std::string_view tooltip, bool logarithmic = false);
  bool slider(std::string_view label, double& value, double min, double max, const char* format,
              std::string_view tooltip, bool logarithmic = false);
  /// Three numbers within the limits, each to drag or to type.
  bool drag(std::string_view label, glm::dvec3& value, float min, float max, std::string_view tooltip);
  /// A field for typing a number within the limits.
  bool number_field(std::string_view label, std::uint32_t& value, std::uint32_t min, std::uint32_t max,
                    std::string_view tooltip);
  /// A field for typing text. True when Enter is pressed in it. It shows a grey `hint` while it is empty.
  /// Asks to put what is typed where `place` says.
  bool text_field(std::string_view label, const std::string& value, const char* hint, std::string_view tooltip,
                  std::string& (*place)(session::Session&, UiState&));
  /// A list to choose from. If true, it is open: combo_item() for each item and ImGui::EndCombo() must follow.
  bool begin_combo(std::string_view label, std::string_view preview, std::string_view tooltip);
  bool combo_item(std::string_view label, bool selected, std::string_view tooltip = "");

  /// Draws a grey label; the next widget begins at `column` and takes the rest of the line.
  void row_label(std::string_view label, float column);
  /// Draws text that takes the rest of the line whatever its length, so that changing digits move no other widget.
  /// text_line() is flush left and wraps text that is too long; right_text() is flush right.
  void text_line(const std::string& text);
  void right_text(const std::string& text);
  /// Draws text that wraps. It is no widget.
  void paragraph(const std::string& text);
  /// The same as a widget without a tooltip, in red if it tells of a problem.
  void wrapped_text(std::string_view label, const std::string& text, bool problem = false);
  /// As paragraph(), in grey.
  void pale_text(const std::string& text);
  /// Draws a line with a grey label and its value at the right.
  void figure(std::string_view label, const std::string& value, std::string_view tooltip);
  /// Draw a coloured square, or a dot, at the start of a line.
  void swatch(const glm::vec3& colour);
  void dot(const glm::vec3& colour);
  /// What the values of a curve are: `meaning`, a sentence for the tooltip, and their unit.
  struct Quantity {
    const char *meaning, *unit;
  };
  /// Draws the last values as a curve without axes. Width 0: the rest of the line.
  void sparkline(std::string_view label, const TimeSeries& series, const Axis& axis, const glm::vec3& colour,
                 const Quantity& quantity, float width = 0);
  /// Draws a line with a grey label, a value and its sparkline.
  void curve(std::string_view label, const std::string& value, const TimeSeries& series, const Axis& axis,
             const glm::vec3& colour, const Quantity& quantity);

  /// Records the last ImGui item as the widget `label`, and shows the tooltip, if any, while the mouse rests on it.
  void register_item(std::string_view label, std::string_view tooltip = "");
  /// The same; returns `used`, which ImGui returned for the item.
  bool register_item(bool used, std::string_view label, std::string_view tooltip) {
    register_item(label, tooltip);
    return used;
  }
  /// Only the tooltip of register_item().
  void tooltip_if_hovered(std::string_view label, std::string_view tooltip);
  /// Shows the tooltip beside the window of the last item, unless the mouse has just clicked.
  void show_tooltip(std::string_view text) const;
  /// Makes tooltips of other windows keep off the current window, which shows results.
  void keep_tooltips_off();

 private:
  /// As register_item(); the tooltip also says how to change a number by dragging or typing.
  void register_number(std::string_view label, std::string_view tooltip);
  /// A number and how it is shown.
  template <class Value>
  struct Number {
    std::string_view label;
    Value &value, min, max;
    const char* format;
  };
  void open_field(ImGuiID id, auto value) {
    input_.field = id;
    input_.field_value = static_cast<double>(value);
  }
  /// Draws a field for typing a number. What is typed takes effect at once. A comma is a decimal point. If the text is
  /// no number or beyond the limits, InputState::field_problem says so.
  template <class Value>
  bool type(const Number<Value>& number);
  /// Draws a number by show(id), an ImGui slider or the like that opens a field for typing. In place of that field,
  /// which drops what it cannot read, draws type().
  template <class Value, class Show>
  bool drag_or_type(const Number<Value>& number, const Show& show);

  float scale_, usual_alpha_;
  InputState& input_;
  const std::map<std::string, bool>& sections_;
  Requests& requests_;
  WidgetRecorder* recorder_;
};

}  // namespace app::ui
