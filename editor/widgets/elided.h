// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

namespace sigs::editor {

// ImGui up to 1.89 ends the program over one text of more than 16,383 letters: four vertices each, counted in 16 bits.
// Texts that come from outside (names, paths, messages that quote them) are cut before it gets them: by one of these,
// or by the widgets here, which do it themselves. In bytes.
constexpr std::size_t kMaxShownText = 2000;

// A text of at most so many bytes, with "..." in its middle where something is missing: messages begin with what they
// are about and end with what is to be done. Never between the bytes of one UTF-8 character.
[[nodiscard]] std::string shortened(const std::string& text, std::size_t maximum = kMaxShownText);

// A text cut to a width of the present font, with "..." at its end where something is missing; "" where not even that
// has room. Quick however long the text is.
[[nodiscard]] std::string elided(const std::string& text, float width);

// The same with "..." at its beginning: of a path the end tells more.
[[nodiscard]] std::string elided_front(const std::string& text, float width);

}  // namespace sigs::editor
