// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "editor/geometry/image_view.h"
#include "editor/views/context.h"
#include "editor/views/viewport/overlays.h"
#include "editor/views/viewport/waypoint_tool.h"

namespace sigs::editor {

// The tabs of a project with several cameras: one for each, which makes it the active one, and one for all of them.
class CameraTabs {
 public:
  // One row high, as wide as the current ImGui window. Only for a project with several cameras.
  void draw(const ViewContext& context);

  // Whether the tab of all cameras is in front.
  [[nodiscard]] bool shows_all() const { return shows_all_; }
  void show_all(bool all) { shows_all_ = all; }

 private:
  bool shows_all_ = false;
  std::size_t active_ = 0;     // camera in the update before
  std::size_t in_front_ = 0;   // tab in the update before; the number of cameras: all of them
  int updates_to_select_ = 2;  // until ImGui has brought the wanted tab to the front
};

// The composited images of all cameras side by side, at the playhead, with the cameras' names and the intruders' boxes,
// paths and waypoints, which are dragged in any of them. A click on one asks for its tab.
class Mosaic {
 public:
  // Fills the current ImGui window.
  void draw(const ViewContext& context, CameraTabs& tabs);

 private:
  struct Cell {
    WaypointMarks marks;
    PathOverlay path;
  };
  void draw_cell(const ViewContext& context, std::size_t camera, const ScreenRect& rect, CameraTabs& tabs);
  // What a press, a drag and a click on an image do. tool: null while no scene is open.
  void handle_mouse(const ViewContext& context, std::size_t camera, const ToolContext* tool, CameraTabs& tabs);

  std::vector<Cell> cells_;  // by camera
  WaypointTool tool_;
  std::size_t held_ = 0;    // camera in whose image the mouse was pressed
  bool opens_tab_ = false;  // when that press ends as a click
};

// Asks for a video, and adds a camera that took it, which is active then.
void ask_add_camera(const ViewContext& context);
// Takes the active camera out, unless it is the first one.
void ask_remove_camera(const ViewContext& context);

// Why a camera shows another time than the playhead's: "left films from frame 11 to 189 only"; "": it does not.
//   shown  of that camera
[[nodiscard]] std::string not_filming_text(const PreviewOutput& shown, int playhead);

}  // namespace sigs::editor
