#pragma once
// Thin layer over Dear ImGui: every widget has its tooltip and, in tests, leaves its label and rectangle behind.

#include <imgui.h>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "app/base/text.h"
#include "app/base/time_series.h"

namespace app {

/// Where each widget of the last frame was. Installed by tests, which aim the mouse by it.
struct Recorder {
  struct Widget {
    std::string label;
    ImVec2 min, max;
    bool enabled;
  };
  std::vector<Widget> widgets;

  const Widget* find(std::string_view label) const;
};

/// What the mouse does, kept from frame to frame.
struct Hover {
  static constexpr float delay = 0.4f;  // s
  // What it rests on and for how long, so that tooltips come only to a mouse that rests.
  std::string label;
  float seconds = 0;
  // The slider that it was pressed on last, and the value till then, which a double-click brings back.
  std::string pressed;
  double before = 0;
};

/// Where what a row of settings holds begins, in design pixels.
inline constexpr float label_column = 108;

ImU32 to_imgui(const glm::vec3& colour, float alpha = 1.0f);

/// The first of `least`, 2, 5, 10, ... times it that is not below `most`: an axis that stays while values change.
float axis_end(float most, float least);

struct Axis {
  float bottom, top;
};
/// Around all values of a series, at least `least` long; it stays while they change a little.
Axis axis_around(const TimeSeries& series, float least);

/// One frame of the panel. Labels are unique, also as ImGui's identifiers.
class Widgets {
 public:
  /// sections: keeps whether each is open; those that are in it at first start like that.
  Widgets(float scale, Hover& hover, std::map<std::string, bool>& sections, Recorder* recorder = nullptr)
      : scale_(scale), usual_alpha_(ImGui::GetStyle().Alpha), hover_(hover), sections_(sections), recorder_(recorder) {}

  /// ImGui units of a length in the design's pixels.
  float px(float design) const { return design * scale_; }

  bool button(const char* label, const char* tooltip, float width = 0);
  bool radio(const char* label, bool active, const char* tooltip);
  bool checkbox(const char* label, bool& value, const char* tooltip);
  /// The title of a part that can be closed; true if its cross is clicked, whose label is "Close " and the title's.
  bool heading(const char* label, const char* tooltip);
  /// A section that folds; true if it is open.
  bool section(const char* label, bool open_at_first);
  /// Sliders take a double-click too, which opens a field for typing.
  bool slider(const char* label, int& value, int least, int most, const char* format, const char* tooltip);
  bool slider(const char* label, float& value, float least, float most, const char* format, const char* tooltip,
              bool logarithmic);
  /// A logarithmic slider over whole numbers.
  bool slider(const char* label, std::uint32_t& value, std::uint32_t least, std::uint32_t most, const char* tooltip);
  /// Three numbers within the limits, each to drag or to type.
  bool drag(const char* label, glm::dvec3& value, float least, float most, const char* tooltip);
  /// A field for typing a number within the limits; takes effect with every digit.
  bool number(const char* label, std::uint32_t& value, std::uint32_t least, std::uint32_t most, const char* tooltip);
  /// A field for typing text, which it holds as typed; true when Enter is pressed in it. Grey `hint` while it is empty.
  bool text(const char* label, std::string& value, const char* hint, const char* tooltip);
  /// A choice from a list; ImGui::EndCombo() must follow if true. Items: choice().
  bool begin_choices(const char* label, const char* preview, const char* tooltip, ImGuiComboFlags flags = 0);
  bool choice(const char* label, bool selected, const char* tooltip);

  /// Grey text that starts a row; what follows stands in the right column and takes its whole width.
  void row(const char* label, float column);
  /// Text that takes the rest of the line whatever it says, flush left or right: changing digits move nothing else.
  /// What is flush left and too long is wrapped.
  void line(const std::string& text);
  void value(const std::string& text);
  /// A line with a grey label and its value at the right.
  void figure(const char* label, const std::string& value, const char* tooltip);
  /// A square of colour in the middle of a line.
  void chip(const glm::vec3& colour, float line_height);
  /// A dot of colour that starts a line.
  void dot(const glm::vec3& colour);
  /// A curve of the last values between the ends of an axis; width 0: what is left of the line.
  void sparkline(const char* label, const TimeSeries& series, const Axis& axis, const glm::vec3& colour,
                 const char* unit, float width = 0);
  /// A line with a grey label, a value and its curve.
  void curve(const char* label, const std::string& value, const TimeSeries& series, const Axis& axis,
             const glm::vec3& colour, const char* unit);

  /// Notes the last ImGui item as the widget `label`, and shows the tooltip, if any, while the mouse rests on it.
  void done(const char* label, const char* tooltip);
  /// The tooltip alone.
  void explain(const char* label, const char* tooltip);
  void show_tooltip(const char* text) const;

 private:
  /// As done(); the tooltip also says how to change a number that is dragged.
  void done_with_number(const char* label, const char* tooltip);
  /// An ImGui slider of `value`, by show(whether its value is about to be typed).
  template <class Value, class Show>
  bool slide(const char* label, Value& value, const Show& show);

  float scale_, usual_alpha_;
  Hover& hover_;
  std::map<std::string, bool>& sections_;
  Recorder* recorder_;
};

}  // namespace app
