// SPDX-License-Identifier: MIT
#include "editor/views/viewport/viewport_view.h"

#include <algorithm>
#include <cmath>

#include "editor/widgets/toolbar.h"

namespace sigs::editor {

namespace {

constexpr double kHandleHeight = 0.8;  // of the rect, from above

// Triangles to both sides on a plate: can be dragged.
void draw_handle(ImDrawList& draw, const glm::dvec2& middle, ImU32 color) {
  const double r = scaled(11);
  draw.AddCircleFilled(im(middle), static_cast<float>(r), IM_COL32(16, 18, 22, 220));
  draw.AddCircle(im(middle), static_cast<float>(r), color, 0, scaled(1.4));
  for (const double side : {-1.0, 1.0})
    draw.AddTriangleFilled(im(middle + side * glm::dvec2(0.65 * r, 0)),
                           im(middle + side * glm::dvec2(0.2 * r, 0.38 * r)),
                           im(middle + side * glm::dvec2(0.2 * r, -0.38 * r)), color);
}

ImageGrid next(ImageGrid grid) {
  if (grid == ImageGrid::none) return ImageGrid::thirds;
  return grid == ImageGrid::thirds ? ImageGrid::eighths : ImageGrid::none;
}

const char* label_of(ImageGrid grid) {
  if (grid == ImageGrid::none) return "Grid";
  return grid == ImageGrid::thirds ? "Grid 3 x 3" : "Grid 8 x 6";
}

}  // namespace

double ViewportWipe::line_x(const ImageCanvas& canvas) const {
  return std::round(canvas.rect.low.x + share_ * canvas.rect.size().x);
}

bool ViewportWipe::is_at(const ImageCanvas& canvas, const glm::dvec2& mouse) const {
  return on_ && std::abs(mouse.x - line_x(canvas)) <= scaled(7);
}

bool ViewportWipe::is_left_of_line(const ImageCanvas& canvas, const glm::dvec2& mouse) const {
  return on_ && mouse.x < line_x(canvas);
}

void ViewportWipe::drag_to(const ImageCanvas& canvas, const glm::dvec2& mouse) {
  share_ = std::clamp((mouse.x - canvas.rect.low.x) / std::max(1.0, canvas.rect.size().x), 0.02, 0.98);
}

void ViewportWipe::draw_footage(const ImageCanvas& canvas, const ViewContext& context, bool everywhere) {
  if (!on_ && !everywhere) return;
  context.needs.footage = true;
  if (!context.shown.footage) return;
  ScreenRect left = canvas.rect;
  if (!everywhere) left.high.x = line_x(canvas);
  draw_image(canvas.draw, context.textures, *context.shown.footage, canvas.view, left);
}

void ViewportWipe::draw_line(const ImageCanvas& canvas, bool highlighted) const {
  if (!on_) return;
  const double x = line_x(canvas);
  const ImU32 color = highlighted ? color::kAccent : IM_COL32(255, 255, 255, 220);
  canvas.draw.AddRectFilled(im({x - 1, canvas.rect.low.y}), im({x + 1, canvas.rect.high.y}), color);
  // Below the middle, where intruders are looked for.
  draw_handle(canvas.draw, {x, std::round(std::lerp(canvas.rect.low.y, canvas.rect.high.y, kHandleHeight))}, color);
  const double bottom = canvas.rect.high.y - scaled(6);
  const double width = ImGui::CalcTextSize("footage").x;
  if (x - canvas.rect.low.x > width + scaled(20))
    draw_label(canvas, {x - width - scaled(10), bottom}, "footage", color::kText);
  if (canvas.rect.high.x - x > width + scaled(40))
    draw_label(canvas, {x + scaled(8), bottom}, "composite", color::kText);
}

void draw_viewport_toolbar(const ViewportSwitches& switches) {
  OverlayChoice& overlays = switches.overlays;
  std::vector<ToolbarItem> items{
      toggle_item(
          {"box", Icon::box, "Box",
           "Boxes of the truth: what is visible solid, the whole silhouette dashed; and those of trackers, where "
           "results are loaded"},
          overlays.box),
      toggle_item({"path", Icon::path, "Path", "The path of each intruder, as seen from here through the lens"},
                  overlays.path),
      toggle_item(
          {"waypoints", Icon::waypoints, "Waypoints",
           "Waypoints with their frames. Drag: move at constant distance; with Shift or Alt: nearer and farther. "
           "Double click on the image: add one"},
          overlays.waypoints),
      toggle_item(
          {"horizon", Icon::horizon, "Horizon",
           "Where the world is level. Drag the line onto the footage's own horizon: its middle up and down, its "
           "ends to tilt it. Numbers: headings against true north where it is known, else against world X; the "
           "circle with wings: where the camera flies to"},
          overlays.horizon),
      toggle_item({"own body", Icon::own_body, "Own body", "The mask of the aircraft that carries the camera"},
                  overlays.own_body),
      {.button = {.id = "grid",
                  .icon = Icon::grid,
                  .label = label_of(overlays.grid),
                  .tooltip = "Lines across the image: thirds, 8 x 6, none",
                  .on = overlays.grid != ImageGrid::none},
       .clicked = [&overlays] { overlays.grid = next(overlays.grid); }},
      {.is_gap = true},
      {.button = {.id = "wipe",
                  .icon = Icon::wipe,
                  .label = "Wipe",
                  .tooltip = "Untouched footage left of a line that can be dragged. Hold \\: footage alone",
                  .on = switches.wipe.is_on()},
       .clicked = [&switches] { switches.wipe.toggle(); }},
      {.is_gap = true},
  };
  ZoomableImage& look = switches.look;
  add_zoom_items(items, {.is_fitted = look.is_fitted(),
                         .zoom = look.zoom(),
                         .fit = [&look] { look.fit(); },
                         .to_exact = [&look] { look.zoom_to(1, look.room_px() / 2.0); }});
  draw_toolbar(items);
}

}  // namespace sigs::editor
