// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "editor/views/studio.h"
#include "editor/views/viewport/horizon_tool.h"
#include "editor/views/viewport/overlays.h"
#include "editor/views/viewport/path.h"
#include "editor/views/viewport/problem_banner.h"
#include "editor/views/viewport/waypoint_tool.h"
#include "editor/views/viewport/wipe.h"
#include "editor/widgets/zoomable_picture.h"

namespace sigs::editor {

// The composited frame at the playhead: zoom, pan, overlays, wipe, waypoints moved over the footage.
class ViewportView {
 public:
  // Into what is left of the current ImGui window.
  void draw(const Studio& studio);

  // The horizon's line over the picture, to be dragged.
  void show_horizon() { overlays_.horizon = true; }

 private:
  enum class Grip { nothing, line, waypoint, horizon, ground };

  void draw_canvas(const Studio& studio, const ScreenRect& rect);
  void draw_opening(const ScreenRect& rect, const Studio& studio) const;
  void take_mouse(const Studio& studio, const PictureCanvas& canvas, const ToolTurn* turn);
  [[nodiscard]] Grip grip_of_press(const ToolTurn* turn);
  void take_press(const PictureCanvas& canvas, const ToolTurn* turn);
  void take_double_click(const Studio& studio, const PictureCanvas& canvas, const ToolTurn* turn);
  void draw_menu(const Studio& studio, const PictureCanvas& canvas, const ToolTurn* turn);
  void draw_waypoint_menu(const Studio& studio);
  void draw_picture_menu(const Studio& studio, const ToolTurn* turn);
  void draw_picture_layers(const Studio& studio, const PictureCanvas& canvas);
  void draw_overlays(const Studio& studio, const PictureCanvas& canvas, const ToolTurn* turn,
                     std::span<const WaypointMark> marks);

  ZoomablePicture look_;
  OverlayChoice overlays_;
  OwnBodyTint own_body_;
  PathOverlay path_;
  WaypointMarks marks_;
  WaypointTool tool_;
  HorizonTool horizon_;
  ViewportWipe wipe_;
  ProblemBanner banner_;

  bool hovered_ = false;
  bool footage_alone_ = false;  // while its key is held
  bool over_footage_ = false;   // what the mouse is at is not composited
  Grip grip_ = Grip::nothing;
  glm::dvec2 grip_mouse_{0, 0};
  std::optional<cv::Point> pixel_;  // under the mouse
  std::optional<WaypointMark> menu_waypoint_;
  std::optional<int> menu_intruder_;
  glm::dvec2 menu_pixel_{0, 0};
};

}  // namespace sigs::editor
