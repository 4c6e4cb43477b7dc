// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

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

// The frame that a person means who types into the frame field: "133"; "+10" and "-5" from the playhead; a time with a
// colon, "0:05.32" or "1:02:03.4", for the frame nearest to it in time (times_s: of each frame, ascending). Clamped to
// the footage; times_s empty: to 0 and above. None for what is no number.
[[nodiscard]] std::optional<int> frame_from_entry(std::string_view entry, int playhead,
                                                  std::span<const double> times_s);

}  // namespace sigs::editor
