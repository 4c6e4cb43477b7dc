// SPDX-License-Identifier: MIT
#include "editor/widgets/texts.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace sigs::editor {

namespace {

constexpr const char* kDots = "...";

float width_of(const std::string& text) {
  return ImGui::CalcTextSize(text.c_str(), text.c_str() + text.size()).x;
}

bool is_inside_character(const std::string& text, std::size_t byte) {
  return byte > 0 && byte < text.size() && (static_cast<unsigned char>(text[byte]) & 0xC0U) == 0x80U;
}

// The first bytes, and the last ones: not between the bytes of one UTF-8 character.
std::string head(const std::string& text, std::size_t bytes) {
  while (is_inside_character(text, bytes)) --bytes;
  return text.substr(0, bytes);
}

std::string tail(const std::string& text, std::size_t bytes) {
  std::size_t from = text.size() - std::min(bytes, text.size());
  while (is_inside_character(text, from)) ++from;
  return text.substr(from);
}

// The longest of what `cut` makes for some number of bytes that has room; "" where none has.
template <class Cut>
std::string longest(const std::string& text, float width, const Cut& cut) {
  std::size_t fits = 0;
  std::size_t too_many = text.size();
  while (too_many - fits > 1) {
    const std::size_t half = (fits + too_many) / 2;
    (width_of(cut(half)) <= width ? fits : too_many) = half;
  }
  return fits == 0 ? std::string() : cut(fits);
}

}  // namespace

std::string shortened(const std::string& text, std::size_t maximum) {
  if (text.size() <= maximum) return text;
  const std::size_t kept = maximum > 3 ? maximum - 3 : 0;
  return head(text, kept - kept / 2) + kDots + tail(text, kept / 2);
}

std::string capitalised(std::string text) {
  const std::string first_word = text.substr(0, text.find(' '));
  if (!text.empty() && first_word.find_first_of("._/") == std::string::npos)
    text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string elided(const std::string& text, float width) {
  if (text.size() <= kMaxShownText && width_of(text) <= width) return text;
  // No panel has room for more letters than that.
  const std::string begin = head(text, kMaxShownText);
  return longest(begin, width, [&](std::size_t bytes) { return head(begin, bytes) + kDots; });
}

std::string elided_front(const std::string& text, float width) {
  if (text.size() <= kMaxShownText && width_of(text) <= width) return text;
  const std::string end = tail(text, kMaxShownText);
  return longest(end, width, [&](std::size_t bytes) { return kDots + tail(end, bytes); });
}

void draw_text(const std::string& text, ImU32 color, std::optional<Font> which) {
  if (which) ImGui::PushFont(font(*which));
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
  if (which) ImGui::PopFont();
}

void draw_wrapped(const std::string& text, ImU32 color, std::optional<Font> which) {
  ImGui::PushTextWrapPos(0);
  draw_text(text, color, which);
  ImGui::PopTextWrapPos();
}

glm::dvec2 text_size(const std::string& text, Font which) {
  const ImFont& face = *font(which);
  return dv(face.CalcTextSizeA(face.FontSize, 1e6F, 0, text.c_str()));
}

std::string distance_text(double distance_m) {
  if (!std::isfinite(distance_m)) return "-";
  const bool far = distance_m >= 9999.5;
  const double value = far ? distance_m / 1000 : distance_m;
  const int digits = value < 9.995 ? 2 : value < 999.95 ? 1 : 0;
  return fmt::format("{:.{}f} {}", value, digits, far ? "km" : "m");
}

std::string pixels_text(double value_px) {
  if (!std::isfinite(value_px)) return "-";
  const double size = std::abs(value_px);
  return fmt::format("{:.{}f} px", value_px, size >= 100 ? 0 : size >= 10 ? 1 : 2);
}

std::string frame_text(double frame) {
  return std::abs(frame - std::round(frame)) < 0.05 ? fmt::format("{:.0f}", frame) : fmt::format("{:.1f}", frame);
}

bool text_input(const char* label, std::string& text, const char* hint, int flags) {
  const bool is_too_long = text.size() > kMaxTypedText;
  std::array<char, kMaxTypedText + 1> typed{};
  if (!is_too_long) std::copy(text.begin(), text.end(), typed.begin());
  const std::string shown = is_too_long ? shortened(text, 200) : std::string(hint);
  const bool answer = ImGui::InputTextWithHint(label, shown.c_str(), typed.data(), typed.size(), flags);
  if (!is_too_long || typed[0] != '\0') text = typed.data();
  return answer;
}

}  // namespace sigs::editor
