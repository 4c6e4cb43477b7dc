// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "editor/geometry/lens_projection.h"
#include "editor/views/context.h"
#include "editor/widgets/zoomable_image.h"

namespace sigs::editor {

// The footage's camera in one frame, with the lens that the images are made through. Overlays are projected by it, so
// they lie where compositing puts the intruders.
struct FootageCamera {
  int frame = 0;
  CameraPose world_from_camera;
  Lens lens;

  // From the camera.
  [[nodiscard]] double distance_m(const glm::dvec3& p_in_world) const {
    return glm::distance(p_in_world, world_from_camera.translation_m);
  }
};

// The camera of a frame (of the footage, from 0) in the newest scene that is open; nothing while no scene is open. For
// the `plain` method, which ignores the lens, it is a pinhole camera with the same intrinsics.
[[nodiscard]] std::optional<FootageCamera> footage_camera_at(const ViewContext& context, int frame);

// The frame whose camera overlays are drawn for: the playhead, or while it plays the one that is shown.
[[nodiscard]] int frame_of_overlays(const ViewContext& context);

// A waypoint projected into the image of that camera. In the waypoint's own frame its pixel is where the intruder is.
// The indices count in the project.
struct WaypointMark {
  int intruder = 0;
  int waypoint = 0;
  double frame = 0;                // the waypoint's moment; not whole where frames are spread evenly
  glm::dvec3 position_m{0, 0, 0};  // in the world
  // Of the image, pixel centres at whole numbers. It may lie outside of the image.
  glm::dvec2 pixel{0, 0};
};

// Marks of all waypoints of all intruders of the document's project; waypoints that the lens does not image are left
// out. The marks are computed again only when the project, the scene or the frame has changed.
class WaypointMarks {
 public:
  // Valid until the next call.
  [[nodiscard]] const std::vector<WaypointMark>& of(const ViewContext& context, const FootageCamera& eye);

 private:
  // Revision of the document and of the scene, and the frame, that the marks are of.
  struct MadeFor {
    std::uint64_t document = 0;
    std::shared_ptr<const OpenedScene> scene;
    int frame = 0;
    int first_frame = 0;  // of the document's range, over which waypoints without frames are spread
    int last_frame = 0;
    [[nodiscard]] bool operator==(const MadeFor&) const = default;
  };
  MadeFor made_for_;
  std::vector<WaypointMark> marks_;
};

// What the waypoint tool and the horizon tool work with in one update; valid for that update.
struct ToolContext {
  const ViewContext& context;
  const ImageCanvas& canvas;
  const FootageCamera& eye;
  std::span<const WaypointMark> marks;
  glm::dvec2 mouse{0, 0};  // on the screen
};

// The waypoint within 9 px of the mouse (where text is 15 px high): the selected one if it is there, else the nearest;
// null where there is none. The pointer is into tool.marks.
[[nodiscard]] const WaypointMark* waypoint_at(const ToolContext& tool);

// The intruder whose box, by the truth of the shown image, is under the mouse; the nearest to the camera of several.
[[nodiscard]] std::optional<int> intruder_at(const ToolContext& tool);

// Adds a waypoint of the current intruder in this frame, behind a pixel of the image, at the distance that the intruder
// has in this frame (300 m where that is not known). Says so where the lens has no ray for the pixel.
void add_waypoint_at(const ToolContext& tool, const glm::dvec2& pixel);

// Moves waypoints over the footage with the mouse: at constant distance from the camera, or along the line of sight
// while Alt or Shift is held. A press on a waypoint of another frame moves the playhead to that frame; where the
// camera's motion has carried the waypoint away from the mouse there, it moves as the mouse does. Dragging an intruder
// that has no waypoint in this frame adds one. One drag is one undo step; Escape takes it back.
class WaypointTool {
 public:
  // For a press of the left button. True: a waypoint or an intruder was under the mouse and may be dragged.
  bool press(const ToolContext& tool);
  void drag(const ToolContext& tool);
  void release(const ViewContext& context);
  // Once per update, before the other calls: after Escape, selects what was dragged again.
  void select_again(const ViewContext& context);
  // Between a press on a waypoint or an intruder and its release, Escape or loss.
  [[nodiscard]] bool is_active() const { return taken_.has_value(); }
  // Whether the mouse has gone far enough since to move it.
  [[nodiscard]] bool has_moved() const { return taken_ && taken_->gesture.is_moving; }

  // While something is dragged: its distance from the camera and how far it was moved, beside the mouse.
  void draw(const ToolContext& tool) const;

 private:
  struct Taken {
    int intruder = 0;
    int waypoint = 0;  // -1: the intruder itself, which has none here
    DragGesture gesture;
    Selection selected_before;  // what Esc comes back to
    bool along = false;
    glm::dvec3 start_m{0, 0, 0};         // where the part of the drag that lasts began
    glm::dvec2 start_mouse{0, 0};        // then, with mouse_to_waypoint
    glm::dvec2 mouse_to_waypoint{0, 0};  // on the screen, when the drag began
    glm::dvec3 now_m{0, 0, 0};
    glm::dvec3 first_m{0, 0, 0};
  };

  [[nodiscard]] bool is_still_there(const ViewContext& context) const;
  bool begin(const ToolContext& tool);
  void move(const ToolContext& tool);

  std::optional<Taken> taken_;
  std::optional<Selection> selected_again_;
  int gestures_ = 0;
};

}  // namespace sigs::editor
