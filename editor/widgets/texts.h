// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "editor/widgets/theme.h"

namespace sigs::editor {

// ImGui up to 1.89 ends the program over one text of more than 16,383 letters: four vertices each, counted in 16 bits.
// Texts that come from outside (names, paths, messages that quote them) are cut before it gets them: by one of these,
// or by the widgets here, which do it themselves. In bytes.
constexpr std::size_t kMaxShownText = 2000;

// A text of at most so many bytes, with "..." in its middle where something is missing: messages begin with what they
// are about and end with what is to be done. Never between the bytes of one UTF-8 character.
[[nodiscard]] std::string shortened(const std::string& text, std::size_t maximum = kMaxShownText);

// With a capital first; a file's name at the beginning stays as it is.
[[nodiscard]] std::string capitalised(std::string text);

// A text cut to a width of the present font, with "..." at its end where something is missing; "" where not even that
// has room. Quick however long the text is.
[[nodiscard]] std::string elided(const std::string& text, float width);

// The same with "..." at its beginning: of a path the end tells more.
[[nodiscard]] std::string elided_front(const std::string& text, float width);

// Draws a text as ImGui's next item: on one line, or wrapped at the window's right edge. Without a font in the present
// one.
void draw_text(const std::string& text, ImU32 color, std::optional<Font> which = std::nullopt);
void draw_wrapped(const std::string& text, ImU32 color, std::optional<Font> which = std::nullopt);
// Width and height of a text in one of the fonts, on one line.
[[nodiscard]] glm::dvec2 text_size(const std::string& text, Font which);

// "0.84 m", "312.4 m", "4.21 km": about four digits, as a person says it.
[[nodiscard]] std::string distance_text(double distance_m);
// "0.42 px", "3.2 px", "210 px"; "-" for what is not finite.
[[nodiscard]] std::string pixels_text(double value_px);

// A moment in frames: "120", or "120.5" where it is no whole frame.
[[nodiscard]] std::string frame_text(double frame);

// What can be typed or pasted into one line, in bytes: as long as the longest path that Linux knows. More is refused
// as it comes.
constexpr std::size_t kMaxTypedText = 4095;

// ImGui's line of text for a string. One that is longer than can be typed is shown cut where the hint is: what is typed
// takes its place as a whole.
//   hint   shown where it is empty; "" for none
//   flags  ImGuiInputTextFlags
bool text_input(const char* label, std::string& text, const char* hint = "", int flags = 0);

}  // namespace sigs::editor
