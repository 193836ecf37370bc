#include "app/ui/views/views.h"

#include <algorithm>

#include <fmt/core.h>

#include "app/ui/widgets/method_mark.h"

namespace app::ui {
namespace {

// In design pixels; the list says at promise_column which methods can miss contacts.
constexpr float list_indent = 12, promise_column = 246;
constexpr const char* show_tooltip =
    "Shows these methods in the comparison (V) and in the plot of error against run time (E). M goes through them.";

/// Draws a check box for all methods that `belongs` accepts. It is half checked if only some of them are shown.
template <class Belongs>
void draw_check_box(Widgets& w, const Session& session, const std::string& label, const Belongs& belongs) {
  compare::MethodSet shown = session.comparison.choice.methods;
  enum { none = 0, some = 1, all = 3 };
  bool any = false, each = true;
  for (std::size_t m = 0; m < shown.size(); ++m) {
    if (!belongs(collide::method_table()[m])) continue;
    any |= shown[m];
    each &= shown[m];
  }
  int state = each ? all : any ? some : none;
  if (!w.register_item(ImGui::CheckboxFlags(label.c_str(), &state, all), label.c_str(), show_tooltip)) return;
  for (std::size_t m = 0; m < shown.size(); ++m)
    if (belongs(collide::method_table()[m])) shown[m] = state == all;
  w.ask([shown](Session& s) { s.comparison.choice.methods = shown; });
}

void draw_method_line(Widgets& w, const Session& session, const collide::Method& method) {
  draw_check_box(w, session, fmt::format("###Show {}", method.name),
                 [&](const collide::Method& each) { return each.key == method.key; });
  ImGui::SameLine();
  draw_method_mark(w, method, ImGui::GetFrameHeight());
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  if (w.combo_item(method.name, method.key == edited(session.simulation).method().key, method.description) &&
      method.can_drive())
    w.ask([&key = method.key](Session& s) { s.settings.set_method(key); });
  const StatusLight light = status_light(method);
  ImGui::SameLine(w.px(promise_column));
  w.dot(light.colour);
  ImGui::TextDisabled("%s", light.label);
}

}  // namespace

void draw_method_choice(Widgets& w, const Session& session, std::string_view label, std::string_view preview,
                        std::string_view tooltip) {
  if (!w.begin_combo(label, preview, tooltip)) return;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {w.px(2), w.px(1)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {w.px(6), w.px(2)});
  draw_check_box(w, session, "All methods", [](const collide::Method&) { return true; });
  for (const collide::MethodGroupName& group : collide::method_groups) {
    const auto belongs = [&](const collide::Method& method) { return method.group == group.group; };
    if (std::ranges::none_of(collide::method_table(), belongs)) continue;
    draw_check_box(w, session, std::string(group.name), belongs);
    ImGui::Indent(w.px(list_indent));
    for (const collide::Method& method : collide::method_table())
      if (belongs(method)) draw_method_line(w, session, method);
    ImGui::Unindent(w.px(list_indent));
  }
  ImGui::PopStyleVar(2);
  ImGui::EndCombo();
}

void draw_shown_methods(Widgets& w, const Session& session) {
  const compare::MethodSet shown = session.comparison.shown_methods();
  const std::string preview = fmt::format("{} of {} methods", std::ranges::count(shown, true), shown.size());
  draw_method_choice(
      w, session, "Shown methods", preview,
      "Chooses which methods are shown. The one that drives the bodies is always shown; its row is shaded.");
}

}  // namespace app::ui
