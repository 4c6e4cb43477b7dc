// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "editor/views/context.h"
#include "editor/views/timeline/ruler.h"

namespace sigs::editor {

// The lanes of the intruder, and below them those of the camera.
enum class LaneGroup { intruder, camera };
inline constexpr std::size_t kLaneGroups = 2;

// Where the header of one of `count` groups is drawn: at its place in the scrolled rows as long as that is in sight,
// else at the edge of the window beyond which it lies, with the other headers above or below it.
//   natural_y         of the header in the scrolled rows
//   top_y, bottom_y   of the window
[[nodiscard]] float header_y(float natural_y, std::size_t index, std::size_t count, float height, float top_y,
                             float bottom_y);

// Headers of the groups of lanes, always in sight whatever is scrolled away. A press folds a group, or unfolds it;
// where most of an open group is out of sight, it brings it into sight instead.
class LaneGroups {
 public:
  // Of a header, in screen pixels.
  [[nodiscard]] static float height();
  [[nodiscard]] bool is_folded(LaneGroup group) const { return folded_[static_cast<std::size_t>(group)]; }

  // Takes presses: before the lanes are drawn, as what is drawn first has the mouse.
  //   header_y  where the headers are among the scrolled rows; the rows of a group end at the next header or at end_y
  void update(const ViewContext& context, const TimelineStrip& strip, std::array<float, kLaneGroups> header_y,
              float end_y);
  // After the lanes, over them.
  void draw(const TimelineStrip& strip) const;

 private:
  void press(std::size_t group, float share_in_sight);

  std::array<bool, kLaneGroups> folded_{};
  std::array<float, kLaneGroups> shown_y_{};  // in this update
  std::optional<std::size_t> hovered_;
  std::optional<std::size_t> wanted_;  // to be brought into sight in the next update
};

}  // namespace sigs::editor
