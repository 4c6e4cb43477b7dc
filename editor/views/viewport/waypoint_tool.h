// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "editor/views/viewport/footage_eye.h"
#include "editor/widgets/picture_marks.h"

namespace sigs::editor {

// What the waypoint tool works with in one turn.
struct ToolTurn {
  const Studio& studio;
  const PictureCanvas& canvas;
  const FootageEye& eye;
  std::span<const WaypointMark> marks;
  glm::dvec2 mouse{0, 0};  // on the screen
};

// The waypoint under the mouse: the selected one before others, then the nearest.
[[nodiscard]] const WaypointMark* waypoint_at(const ToolTurn& turn);

// The intruder whose box, by the truth of the shown picture, is under the mouse; the nearest to the camera of several.
[[nodiscard]] std::optional<int> intruder_at(const ToolTurn& turn);

// A waypoint here, at the distance that the intruder has at this moment.
void add_waypoint_at(const ToolTurn& turn, const glm::dvec2& pixel);

// Takes waypoints over the footage: at constant distance from the camera, with Alt or Shift along the line of sight. A
// waypoint of another frame is gone to when it is taken; it is dragged on only where it is seen under the mouse then.
// An intruder that has no waypoint in this frame gets one when it is dragged. One drag is one step of undo; Esc takes
// it back.
class WaypointTool {
 public:
  // Whether the press took hold of something.
  bool press(const ToolTurn& turn);
  void drag(const ToolTurn& turn);
  void release(const Studio& studio);
  void select_again(const Studio& studio);  // once a turn, before anything else
  [[nodiscard]] bool is_active() const { return taken_.has_value(); }

  // Distance beside the mouse, while something is dragged.
  void draw(const ToolTurn& turn) const;

 private:
  struct Taken {
    int intruder = 0;
    int waypoint = 0;     // -1: the intruder itself, which has none here
    std::string gesture;  // "" until it moves
    std::uint64_t revision_before = 0;
    Selection selected_before;  // what Esc comes back to
    glm::dvec2 pressed{0, 0};   // where the mouse was taken, on the screen
    bool moving = false;
    bool along = false;
    glm::dvec3 start_m{0, 0, 0};  // where the part of the drag that lasts began
    glm::dvec2 start_mouse{0, 0};
    glm::dvec3 now_m{0, 0, 0};
    glm::dvec3 first_m{0, 0, 0};
  };

  [[nodiscard]] bool is_still_there(const Studio& studio) const;
  [[nodiscard]] bool is_under_press(const ToolTurn& turn, const glm::dvec3& position_m) const;
  bool begin(const ToolTurn& turn);
  void cancel(const Studio& studio);
  void move(const ToolTurn& turn);

  std::optional<Taken> taken_;
  std::optional<Selection> selected_again_;
  int gestures_ = 0;
};

}  // namespace sigs::editor
