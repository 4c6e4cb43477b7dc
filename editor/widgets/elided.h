// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace sigs::editor {

// A text cut to a width of the present font, with "..." at its end where something is missing; "" where not even that
// has room.
[[nodiscard]] std::string elided(const std::string& text, float width);

}  // namespace sigs::editor
