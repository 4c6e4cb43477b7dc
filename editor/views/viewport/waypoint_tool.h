// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "editor/views/viewport/footage_camera.h"
#include "editor/widgets/image_canvas.h"

namespace sigs::editor {

// What the waypoint tool works with in one update.
struct ToolContext {
  const ViewContext& context;
  const ImageCanvas& canvas;
  const FootageCamera& eye;
  std::span<const WaypointMark> marks;
  glm::dvec2 mouse{0, 0};  // on the screen
};

// The waypoint under the mouse: the selected one before others, then the nearest.
[[nodiscard]] const WaypointMark* waypoint_at(const ToolContext& tool);

// The intruder whose box, by the truth of the shown image, is under the mouse; the nearest to the camera of several.
[[nodiscard]] std::optional<int> intruder_at(const ToolContext& tool);

// A waypoint here, at the distance that the intruder has at this moment.
void add_waypoint_at(const ToolContext& tool, const glm::dvec2& pixel);

// Takes waypoints over the footage: at constant distance from the camera, with Alt or Shift along the line of sight. A
// waypoint of another frame is gone to when it is taken; it is dragged on only where it is seen under the mouse then.
// An intruder that has no waypoint in this frame gets one when it is dragged. One drag is one step of undo; Esc takes
// it back.
class WaypointTool {
 public:
  // Whether the press took hold of something.
  bool press(const ToolContext& tool);
  void drag(const ToolContext& tool);
  void release(const ViewContext& context);
  void select_again(const ViewContext& context);  // once per update, before anything else
  [[nodiscard]] bool is_active() const { return taken_.has_value(); }

  // Distance beside the mouse, while something is dragged.
  void draw(const ToolContext& tool) const;

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

  [[nodiscard]] bool is_still_there(const ViewContext& context) const;
  [[nodiscard]] bool is_under_press(const ToolContext& tool, const glm::dvec3& position_m) const;
  bool begin(const ToolContext& tool);
  void cancel(const ViewContext& context);
  void move(const ToolContext& tool);

  std::optional<Taken> taken_;
  std::optional<Selection> selected_again_;
  int gestures_ = 0;
};

}  // namespace sigs::editor
