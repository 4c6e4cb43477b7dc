// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "editor/views/studio.h"

namespace sigs::editor {

// Buttons for playing and stepping, the playhead's time and frame, in and out. Where there is little room the less
// needed ones are left out; their keys work all the same.
class TransportBar {
 public:
  // One line high.
  void draw(const Studio& studio);

 private:
  void draw_frame_field(const Studio& studio, float width);

  std::array<char, 32> entry_{};  // what is typed into the frame field
  bool typing_ = false;
};

}  // namespace sigs::editor
