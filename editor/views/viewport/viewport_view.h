// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "editor/views/context.h"
#include "editor/views/viewport/horizon_tool.h"
#include "editor/views/viewport/overlays.h"
#include "editor/views/viewport/readout.h"
#include "editor/views/viewport/toolbar.h"
#include "editor/views/viewport/waypoint_tool.h"
#include "editor/widgets/zoomable_image.h"

namespace sigs::editor {

// The view of the composited frame at the playhead. The user zooms and pans it, switches overlays, compares it with the
// untouched footage (wipe), and moves waypoints and the horizon over it. A waypoint drag goes through handle_mouse to
// WaypointTool, which puts changes of the project into context.edits; the frame that is shown comes in context.shown.
class ViewportView {
 public:
  // Into what is left of the current ImGui window.
  void draw(const ViewContext& context);

  // Switches the horizon's line on, so that it can be dragged.
  void show_horizon() { overlays_.horizon = true; }

 private:
  // What the mouse holds since its press: the wipe's line, a waypoint or intruder, the horizon, or the image itself.
  enum class Grip { nothing, line, waypoint, horizon, ground };

  void draw_canvas(const ViewContext& context, const ScreenRect& rect);
  void draw_opening(const ScreenRect& rect, const ViewContext& context) const;
  void handle_mouse(const ViewContext& context, const ImageCanvas& canvas, const ToolContext* tool);
  [[nodiscard]] Grip grip_of_press(const ToolContext* tool);
  void handle_press(const ImageCanvas& canvas, const ToolContext* tool);
  void handle_double_click(const ViewContext& context, const ImageCanvas& canvas, const ToolContext* tool);
  void draw_menu(const ViewContext& context, const ImageCanvas& canvas, const ToolContext* tool);
  void draw_waypoint_menu(const ViewContext& context);
  void draw_image_menu(const ViewContext& context, const ToolContext* tool);
  void draw_image_layers(const ViewContext& context, const ImageCanvas& canvas);
  void draw_overlays(const ViewContext& context, const ImageCanvas& canvas, const ToolContext* tool,
                     std::span<const WaypointMark> marks);

  ZoomableImage look_;
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
