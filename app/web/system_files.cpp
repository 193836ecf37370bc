// What a page in a browser has in place of session/system_files.cpp, and what page.js calls. What page.js offers stands
// in `Module`.

#include "app/session/system_files.h"

#include <emscripten.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <utility>

namespace app::session {
namespace {

bool is_option(const std::string& word) { return word.starts_with("--"); }

std::string encoded(const std::string& text) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-.,:=~";
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string all;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (plain.find(c) != plain.npos)
      all += c;
    else
      all.append(1, '%').append(1, digits[byte >> 4u]).append(1, digits[byte & 15u]);
  }
  return all;
}

/// Returns a link to this page; nothing for files, which only this visit of the page has.
std::string link(const std::vector<std::string>& words) {
  std::string text = emscripten_run_script_string("location.href.split(/[?#]/)[0]");
  char before = '?';
  for (const std::string& word : words) {
    if (word.find('/') != word.npos) return {};
    const char separator = is_option(word) ? std::exchange(before, '&') : '=';
    text.append(1, separator).append(encoded(is_option(word) ? word.substr(2) : word));
  }
  return text;
}

constexpr System with_mouse{
    .how_to = "Drag a body to pull it. Drag the background to orbit. B throws a body. G: tour. ?: help.",
    .start = "Link",
    .no_start = "No link makes this scene: save it, and hand out its file, which can be dropped here.",
    .start_text = &link,
    .choose_files = [] { emscripten_run_script("Module.chooseFiles()"); }};

constexpr System with_fingers = [] {
  System page = with_mouse;
  page.how_to = "One finger orbits; if it rests before it moves, it drags a body. Two pan and zoom.";
  return page;
}();

}  // namespace

const System& this_system() {
  static const bool fingers = emscripten_run_script_int("matchMedia('(pointer: coarse)').matches");
  return fingers ? with_fingers : with_mouse;
}

std::span<const RecordingKind> recording_kinds() { return {}; }

/// Returns a file that page.js keeps from one visit to the next.
std::filesystem::path preferences_path() { return "/preferences.toml"; }

std::string hand_over(const std::filesystem::path& file) {
  EM_ASM({ Module.download(UTF8ToString($0)); }, file.c_str());
  return file.filename().string() + ", a download";
}

}  // namespace app::session

/// Returns true if a part of the user interface is here (CSS pixels), else the scene is.
extern "C" EMSCRIPTEN_KEEPALIVE bool page_over_interface(float x, float y) {
  const ImVector<ImGuiWindow*>& windows = ImGui::GetCurrentContext()->Windows;
  return std::any_of(windows.begin(), windows.end(), [&](const ImGuiWindow* w) {
    return w->WasActive && !w->Hidden && !(w->Flags & ImGuiWindowFlags_NoMouseInputs) && w->Rect().Contains({x, y});
  });
}
