#include "engine/gui_theme.h"

#include <imgui.h>

#include <array>
#include <cassert>
#include <fstream>

namespace engine {
namespace {

// Font files on Debian, Ubuntu, Fedora and Arch, best font first.
constexpr std::array font_files{
    "/usr/share/fonts/opentype/inter/Inter-Regular.otf",
    "/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Regular.ttf",
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf",
};

// First and last characters: Latin, Greek, dashes and quotes, superscripts, arrows, mathematical signs, simple shapes.
constexpr std::array<ImWchar, 15> glyph_ranges{0x0020, 0x00ff, 0x0370, 0x03ff, 0x2010, 0x2027, 0x2070, 0x209f,
                                               0x2190, 0x2199, 0x2200, 0x22ff, 0x25a0, 0x25ff, 0};

ImVec4 rgba(unsigned rgb, float alpha = 1.0f) {
  const auto channel = [&](int shift) { return static_cast<float>((rgb >> shift) & 0xffu) / 255.0f; };
  return {channel(16), channel(8), channel(0), alpha};
}

void set_colours(ImVec4* colours) {
  const unsigned ink = 0x22272e, accent = 0x2f6fb5;
  colours[ImGuiCol_Text] = rgba(ink);
  colours[ImGuiCol_TextDisabled] = rgba(0x5f6873);  // contrast 5 to 1 on the docks
  colours[ImGuiCol_WindowBg] = rgba(0xf8f9fa, 0.95f);
  colours[ImGuiCol_ChildBg] = rgba(0xffffff, 0.0f);
  colours[ImGuiCol_PopupBg] = rgba(0xffffff, 0.98f);
  colours[ImGuiCol_Border] = rgba(ink, 0.14f);
  colours[ImGuiCol_FrameBg] = rgba(ink, 0.07f);
  colours[ImGuiCol_FrameBgHovered] = rgba(accent, 0.16f);
  colours[ImGuiCol_FrameBgActive] = rgba(accent, 0.24f);
  colours[ImGuiCol_TitleBg] = colours[ImGuiCol_TitleBgActive] = rgba(0xebedf0);
  colours[ImGuiCol_TitleBgCollapsed] = rgba(0xebedf0, 0.85f);
  colours[ImGuiCol_MenuBarBg] = rgba(0xf0f2f4);
  colours[ImGuiCol_ScrollbarBg] = rgba(ink, 0.0f);
  colours[ImGuiCol_ScrollbarGrab] = rgba(ink, 0.20f);
  colours[ImGuiCol_ScrollbarGrabHovered] = rgba(ink, 0.32f);
  colours[ImGuiCol_ScrollbarGrabActive] = rgba(ink, 0.45f);
  colours[ImGuiCol_CheckMark] = rgba(accent);
  colours[ImGuiCol_SliderGrab] = rgba(accent, 0.85f);
  colours[ImGuiCol_SliderGrabActive] = rgba(accent);
  colours[ImGuiCol_Button] = rgba(ink, 0.08f);
  colours[ImGuiCol_ButtonHovered] = rgba(accent, 0.20f);
  colours[ImGuiCol_ButtonActive] = rgba(accent, 0.34f);
  colours[ImGuiCol_Header] = rgba(accent, 0.13f);
  colours[ImGuiCol_HeaderHovered] = rgba(accent, 0.20f);
  colours[ImGuiCol_HeaderActive] = rgba(accent, 0.28f);
  colours[ImGuiCol_Separator] = rgba(ink, 0.12f);
  colours[ImGuiCol_ResizeGrip] = rgba(ink, 0.0f);
  colours[ImGuiCol_ResizeGripHovered] = rgba(accent, 0.25f);
  colours[ImGuiCol_ResizeGripActive] = rgba(accent, 0.45f);
  colours[ImGuiCol_Tab] = rgba(ink, 0.05f);
  colours[ImGuiCol_TabHovered] = rgba(accent, 0.22f);
  colours[ImGuiCol_TableHeaderBg] = rgba(ink, 0.06f);
  colours[ImGuiCol_TableBorderStrong] = rgba(ink, 0.16f);
  colours[ImGuiCol_TableBorderLight] = rgba(ink, 0.08f);
  colours[ImGuiCol_TableRowBgAlt] = rgba(ink, 0.03f);
  colours[ImGuiCol_PlotLines] = colours[ImGuiCol_PlotHistogram] = rgba(accent);
  colours[ImGuiCol_PlotLinesHovered] = colours[ImGuiCol_PlotHistogramHovered] = rgba(0xd9822b);
  colours[ImGuiCol_TextSelectedBg] = rgba(accent, 0.28f);
  colours[ImGuiCol_ModalWindowDimBg] = rgba(ink, 0.25f);
}

bool is_readable(const char* file) { return std::ifstream(file).good(); }

}  // namespace

void apply_theme(float scale) {
  assert(scale > 0.0f);
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  ImGui::StyleColorsLight(&style);
  set_colours(style.Colors);
  style.DisabledAlpha = 0.7f;  // keeps a contrast of 5 to 1 on buttons
  style.WindowPadding = {14.0f, 12.0f};
  style.FramePadding = {8.0f, 4.0f};
  style.ItemSpacing = {8.0f, 6.0f};
  style.ItemInnerSpacing = {8.0f, 4.0f};
  style.WindowRounding = 8.0f;
  style.ChildRounding = style.PopupRounding = 6.0f;
  style.FrameRounding = style.GrabRounding = style.TabRounding = 4.0f;
  style.ScrollbarRounding = 6.0f;
  style.ScrollbarSize = 11.0f;
  style.GrabMinSize = 12.0f;
  style.WindowBorderSize = 1.0f;
  style.WindowTitleAlign = {0.0f, 0.5f};
  style.WindowMenuButtonPosition = ImGuiDir_Right;
  style.ScaleAllSizes(scale);
}

void load_font(float pixels) {
  assert(pixels > 0.0f);
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  ImFontConfig config;
  config.OversampleH = 2;
  config.OversampleV = 1;
  config.PixelSnapH = false;
  for (const char* file : font_files) {
    if (is_readable(file) && atlas.AddFontFromFileTTF(file, pixels, &config, glyph_ranges.data()) != nullptr) return;
  }
  config.SizePixels = pixels;
  atlas.AddFontDefault(&config);
}

}  // namespace engine
