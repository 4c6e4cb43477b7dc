// SPDX-License-Identifier: MIT
#pragma once

namespace sigs::editor {

// A bar between two panels that is dragged with the mouse; a double click asks for the usual size. Drawn at the current
// cursor place, `length` long.
struct SplitterMove {
  double by_px = 0;
  bool reset = false;
};
[[nodiscard]] SplitterMove vertical_splitter(const char* id, float length);    // left | right
[[nodiscard]] SplitterMove horizontal_splitter(const char* id, float length);  // upper / lower
[[nodiscard]] float splitter_thickness();

}  // namespace sigs::editor
