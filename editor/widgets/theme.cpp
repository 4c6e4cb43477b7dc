// SPDX-License-Identifier: MIT
#include "editor/widgets/theme.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace sigs::editor {

namespace {

constexpr double kUsualText_px = 15;

ImVec4 rgb(int r, int g, int b, double opacity = 1) {
  return {static_cast<float>(r) / 255, static_cast<float>(g) / 255, static_cast<float>(b) / 255,
          static_cast<float>(opacity)};
}

void set_surfaces(ImVec4* colors) {
  colors[ImGuiCol_WindowBg] = rgb(30, 32, 37);
  colors[ImGuiCol_ChildBg] = rgb(30, 32, 37, 0);
  colors[ImGuiCol_PopupBg] = rgb(38, 41, 48);
  colors[ImGuiCol_MenuBarBg] = rgb(24, 26, 30);
  colors[ImGuiCol_Border] = rgb(255, 255, 255, 0.09);
  colors[ImGuiCol_Separator] = rgb(255, 255, 255, 0.09);
  colors[ImGuiCol_TitleBg] = colors[ImGuiCol_TitleBgActive] = rgb(24, 26, 30);
  colors[ImGuiCol_ScrollbarBg] = rgb(0, 0, 0, 0);
  colors[ImGuiCol_ScrollbarGrab] = rgb(255, 255, 255, 0.14);
  colors[ImGuiCol_ScrollbarGrabHovered] = rgb(255, 255, 255, 0.24);
  colors[ImGuiCol_ScrollbarGrabActive] = rgb(255, 255, 255, 0.34);
  colors[ImGuiCol_ModalWindowDimBg] = rgb(8, 9, 11, 0.6);
  colors[ImGuiCol_TableHeaderBg] = rgb(38, 41, 48);
  colors[ImGuiCol_TableBorderLight] = colors[ImGuiCol_TableBorderStrong] = rgb(255, 255, 255, 0.08);
  colors[ImGuiCol_TableRowBgAlt] = rgb(255, 255, 255, 0.025);
}

void set_controls(ImVec4* colors) {
  colors[ImGuiCol_Text] = rgb(226, 229, 235);
  colors[ImGuiCol_TextDisabled] = rgb(150, 156, 168);
  colors[ImGuiCol_FrameBg] = rgb(46, 49, 57);
  colors[ImGuiCol_FrameBgHovered] = rgb(56, 60, 70);
  colors[ImGuiCol_FrameBgActive] = rgb(62, 67, 79);
  colors[ImGuiCol_Button] = rgb(52, 56, 66);
  colors[ImGuiCol_ButtonHovered] = rgb(66, 72, 85);
  colors[ImGuiCol_ButtonActive] = rgb(45, 110, 180);
  colors[ImGuiCol_Header] = rgb(44, 48, 57);
  colors[ImGuiCol_HeaderHovered] = rgb(56, 61, 72);
  colors[ImGuiCol_HeaderActive] = rgb(48, 84, 128);
  colors[ImGuiCol_CheckMark] = rgb(88, 166, 255);
  colors[ImGuiCol_SliderGrab] = rgb(88, 150, 225);
  colors[ImGuiCol_SliderGrabActive] = rgb(120, 184, 255);
  colors[ImGuiCol_Tab] = rgb(36, 39, 45);
  colors[ImGuiCol_TabHovered] = rgb(60, 66, 79);
  colors[ImGuiCol_TabActive] = rgb(52, 58, 70);
  colors[ImGuiCol_TabUnfocused] = colors[ImGuiCol_Tab];
  colors[ImGuiCol_TabUnfocusedActive] = colors[ImGuiCol_TabActive];
  colors[ImGuiCol_ResizeGrip] = rgb(255, 255, 255, 0.1);
  colors[ImGuiCol_TextSelectedBg] = rgb(88, 166, 255, 0.35);
  colors[ImGuiCol_DragDropTarget] = rgb(88, 166, 255);
  colors[ImGuiCol_NavHighlight] = rgb(88, 166, 255);
  colors[ImGuiCol_PlotHistogram] = rgb(88, 166, 255);
}

std::filesystem::path first_of(const std::vector<std::filesystem::path>& paths) {
  const auto found = std::ranges::find_if(paths, [](const auto& path) {
    std::error_code code;
    return std::filesystem::exists(path, code);
  });
  return found == paths.end() ? std::filesystem::path() : *found;
}

// The text font of Debian's fonts-inter, or of the packages most desktops have.
std::filesystem::path font_file(const std::string& weight) {
  const std::string roboto = weight == "SemiBold" ? "Medium" : "Regular";
  return first_of({fmt::format("/usr/share/fonts/opentype/inter/Inter-{}.otf", weight),
                   fmt::format("/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-{}.ttf", roboto),
                   "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"});
}

void add_font(const std::filesystem::path& file, double size_px) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  // Latin with its accents, Greek, arrows, mathematical signs and the marks that the views use.
  static const std::array<ImWchar, 13> kRanges{0x20,   0x17F,  0x391,  0x3C9,  0x2010, 0x2044, 0x2190,
                                               0x21FF, 0x2200, 0x22FF, 0x25A0, 0x25FF, 0};
  ImFontConfig config;
  config.OversampleH = 2;
  config.OversampleV = 1;
  config.PixelSnapH = true;
  const auto size = static_cast<float>(std::round(size_px));
  if (!file.empty())
    if (atlas.AddFontFromFileTTF(file.c_str(), size, &config, kRanges.data()) != nullptr) return;
  ImFontConfig own;
  own.SizePixels = size;
  atlas.AddFontDefault(&own);
}

}  // namespace

ImU32 intruder_color(int intruder) {
  static constexpr std::array<ImU32, 8> kColors{IM_COL32(255, 140, 90, 255),  IM_COL32(120, 200, 255, 255),
                                                IM_COL32(170, 220, 110, 255), IM_COL32(240, 130, 200, 255),
                                                IM_COL32(255, 205, 90, 255),  IM_COL32(150, 150, 255, 255),
                                                IM_COL32(110, 220, 200, 255), IM_COL32(255, 120, 120, 255)};
  return kColors[static_cast<std::size_t>(std::max(0, intruder)) % kColors.size()];
}

ImU32 result_color(int number) {
  static constexpr std::array<ImU32, 8> kColors{IM_COL32(255, 84, 196, 255), IM_COL32(64, 226, 235, 255),
                                                IM_COL32(150, 236, 84, 255), IM_COL32(176, 138, 255, 255),
                                                IM_COL32(255, 112, 98, 255), IM_COL32(238, 240, 245, 255),
                                                IM_COL32(60, 200, 150, 255), IM_COL32(214, 168, 122, 255)};
  return kColors[static_cast<std::size_t>(std::max(0, number)) % kColors.size()];
}

ImU32 faded(ImU32 color, double opacity) {
  const auto alpha = static_cast<ImU32>(std::lround(255 * std::clamp(opacity, 0.0, 1.0)));
  return (color & ~IM_COL32_A_MASK) | (alpha << IM_COL32_A_SHIFT);
}

void apply_theme() {
  ImGuiStyle style;
  style.WindowPadding = {10, 8};
  style.FramePadding = {8, 4};
  style.CellPadding = {6, 3};
  style.ItemSpacing = {8, 6};
  style.ItemInnerSpacing = {6, 4};
  style.IndentSpacing = 14;
  style.ScrollbarSize = 12;
  style.GrabMinSize = 10;
  style.WindowRounding = 6;
  style.ChildRounding = 4;
  style.FrameRounding = 4;
  style.PopupRounding = 6;
  style.ScrollbarRounding = 6;
  style.GrabRounding = 4;
  style.TabRounding = 4;
  style.WindowBorderSize = 0;
  style.ChildBorderSize = 0;
  style.PopupBorderSize = 1;
  style.WindowTitleAlign = {0.5F, 0.5F};
  style.WindowMenuButtonPosition = ImGuiDir_None;
  style.DisabledAlpha = 0.45F;
  set_surfaces(style.Colors);
  set_controls(style.Colors);
  style.ScaleAllSizes(scaled(1));
  ImGui::GetStyle() = style;
}

ImFont* font(Font which) {
  return ImGui::GetIO().Fonts->Fonts[static_cast<int>(which)];
}

float scaled(double size) {
  return static_cast<float>(size / kUsualText_px) * font(Font::text)->FontSize;
}

void load_fonts(double text_px) {
  ImGui::GetIO().Fonts->Clear();
  const std::filesystem::path regular = font_file("Regular");
  const std::filesystem::path semi_bold = font_file("SemiBold");
  // In the order of Font.
  add_font(regular, text_px);
  add_font(regular, text_px * 0.87);
  add_font(semi_bold, text_px);
  add_font(semi_bold, text_px * 1.7);
  add_font(first_of({"/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf"}), text_px * 0.9);
  ImGui::GetIO().Fonts->Build();
}

}  // namespace sigs::editor
