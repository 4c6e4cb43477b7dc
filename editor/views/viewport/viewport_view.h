// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "editor/geometry/image_view.h"
#include "editor/views/context.h"
#include "editor/views/viewport/box_tool.h"
#include "editor/views/viewport/horizon_tool.h"
#include "editor/views/viewport/overlays.h"
#include "editor/views/viewport/waypoint_tool.h"
#include "editor/widgets/zoomable_image.h"

namespace sigs::editor {

// The untouched footage left of a line that is dragged, or, while a key is held, everywhere.
class ViewportWipe {
 public:
  [[nodiscard]] bool is_on() const { return on_; }
  void toggle() { on_ = !on_; }

  // Whether a press there takes hold of the line. Points are on the screen.
  [[nodiscard]] bool is_at(const ImageCanvas& canvas, const glm::dvec2& mouse) const;
  // Whether the untouched footage is shown there, while it is on.
  [[nodiscard]] bool is_left_of_line(const ImageCanvas& canvas, const glm::dvec2& mouse) const;
  // Moves the line to the mouse, but not out of sight.
  void drag_to(const ImageCanvas& canvas, const glm::dvec2& mouse);

  // The footage over the image; asks for it in the context's needs.
  void draw_footage(const ImageCanvas& canvas, const ViewContext& context, bool everywhere);
  void draw_line(const ImageCanvas& canvas, bool highlighted) const;

 private:
  [[nodiscard]] double line_x(const ImageCanvas& canvas) const;

  bool on_ = false;
  // Where the line is, of the width of the canvas: it stays there while the image is zoomed and panned.
  double share_ = 0.5;
};

// The line below the image: what the mouse is over, and what the image is.
struct ViewportReadout {
  std::optional<cv::Point> pixel;  // the pixel under the mouse; none: beside the image
  bool of_footage = false;         // its colour is the untouched footage's, not the composited image's
  double zoom = 1;                 // screen pixels for each pixel of the image
};

// The image whose pixels are named: the composited one, or the untouched footage. Empty: it is not there yet.
[[nodiscard]] PatchedImage watched_image(const ViewContext& context, bool of_footage);

// In screen pixels, for the fonts that are loaded.
[[nodiscard]] float readout_height();
// At the cursor, as wide as the window. Where there is little room, the less important parts are left out.
void draw_readout(const ViewContext& context, const ViewportReadout& readout);

// What is missing or wrong with what is shown, in sentences, each once: the footage, what was replaced by a
// placeholder, else the problem of the image itself. image: may be null.
[[nodiscard]] std::vector<std::string> problems_of(const ViewContext& context, const PreviewImage* image);

// These problems, over the upper left of an image, without hiding much of it. A click folds it up; other problems
// unfold it.
class ProblemBanner {
 public:
  // To be called before the image takes the mouse: what lies on top comes first. No problems: nothing is shown.
  void handle_mouse(const ScreenRect& rect, std::vector<std::string> problems);
  // After the image was drawn.
  void draw(ImDrawList& draw) const;

 private:
  // A text and the height that it has when wrapped, in screen pixels.
  struct Line {
    std::string text;
    float height = 0;
  };
  void lay_out(const ScreenRect& rect);

  std::vector<std::string> problems_;
  std::vector<Line> lines_;
  // What the banner covers on the screen.
  ScreenRect plate_;
  bool folded_ = false;
  bool hovered_ = false;
};

// The view of the composited frame at the playhead. The user zooms and pans it, switches overlays, compares it with the
// untouched footage (wipe), and moves waypoints and the horizon over it. A waypoint drag goes through handle_mouse to
// WaypointTool, which puts changes of the project into context.edits; the frame that is shown comes in context.shown.
class ViewportView {
 public:
  // Once per update, into what is left of the current ImGui window: toolbar, image, readout.
  void draw(const ViewContext& context);

  // The next drag over the image is a box around something lit (LightLike); Escape and a click end that.
  void ask_for_lit_box() { boxes_.ask_for_lit_box(); }

  // Switches the horizon's line on, so that it can be dragged.
  void show_horizon() { overlays_.horizon = true; }

 private:
  // What the mouse holds since its press: nothing, the wipe's line, a waypoint or intruder, the horizon, a corner of a
  // box, or the image itself, which is panned.
  enum class Grip { nothing, line, waypoint, horizon, box, ground };

  void draw_toolbar_row();
  // The image and all over it, in `rect` of the screen. `tool` below is null while no scene is open.
  void draw_canvas(const ViewContext& context, const ScreenRect& rect);
  // A line of text while there is no image yet.
  void draw_opening(const ScreenRect& rect, const ViewContext& context) const;
  // Goes on with what the mouse holds, or lets it go.
  void handle_mouse(const ViewContext& context, const ImageCanvas& canvas, const ToolContext* tool);
  // What a press of the left button takes, save for the wipe's line; the tool that it belongs to begins its drag.
  [[nodiscard]] Grip grip_of_press(const ToolContext* tool);
  void handle_press(const ImageCanvas& canvas, const ToolContext* tool);
  // Adds a waypoint where that is possible, else fits the image.
  void handle_double_click(const ViewContext& context, const ImageCanvas& canvas, const ToolContext* tool);
  // The menu of the right button, for what was under the mouse when it opened.
  void draw_menu(const ViewContext& context, const ImageCanvas& canvas, const ToolContext* tool);
  void draw_waypoint_menu(const ViewContext& context);
  void draw_image_menu(const ViewContext& context, const ToolContext* tool);
  // The composited image, and the untouched footage over it where the wipe says so.
  void draw_image_layers(const ViewContext& context, const ImageCanvas& canvas);
  void draw_overlays(const ViewContext& context, const ImageCanvas& canvas, const ToolContext* tool,
                     std::span<const WaypointMark> marks);

  // Zoom and place of the image.
  ZoomableImage look_;
  OverlayChoice overlays_;
  MaskTint own_body_;
  MaskTint clouds_;
  PathOverlay path_;
  WaypointMarks marks_;
  WaypointTool tool_;
  HorizonTool horizon_;
  BoxTool boxes_;
  ViewportWipe wipe_;
  ProblemBanner banner_;

  bool hovered_ = false;
  bool footage_alone_ = false;  // the key that shows the footage alone is held
  // What the mouse is at is the untouched footage.
  bool over_footage_ = false;
  Grip grip_ = Grip::nothing;
  glm::dvec2 grip_mouse_{0, 0};     // where the mouse was pressed, on the screen
  std::optional<cv::Point> pixel_;  // under the mouse; none: beside the image
  // What the menu was opened on: a waypoint, an intruder by its index in the project, and the pixel of the image.
  std::optional<WaypointMark> menu_waypoint_;
  std::optional<int> menu_intruder_;
  glm::dvec2 menu_pixel_{0, 0};
};

}  // namespace sigs::editor
