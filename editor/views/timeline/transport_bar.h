// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "editor/views/context.h"

namespace sigs::editor {

// Buttons for playing and stepping, the playhead's time and frame, in and out. Where there is little room the less
// needed ones are left out; their keys work all the same.
class TransportBar {
 public:
  // One line high.
  void draw(const ViewContext& context);

 private:
  void draw_frame_field(const ViewContext& context, float width);

  std::array<char, 32> entry_{};  // what is typed into the frame field
  bool typing_ = false;
};

}  // namespace sigs::editor
