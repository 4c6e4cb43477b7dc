// SPDX-License-Identifier: MIT
#include "editor/views/viewport/toolbar.h"

#include <string>
#include <vector>

#include "editor/views/viewport/image_icons.h"
#include "editor/widgets/toolbar.h"

namespace sigs::editor {

namespace {

ToolbarItem switch_of(const char* id, IconDrawing icon, const char* label, const char* tooltip, bool& on) {
  return {.button = {.id = id, .icon = icon, .label = label, .tooltip = tooltip, .on = on},
          .clicked = [&on] { on = !on; }};
}

ToolbarItem gap() {
  return {.is_gap = true};
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

void draw_viewport_toolbar(const ViewportSwitches& switches) {
  OverlayChoice& overlays = switches.overlays;
  const std::vector<ToolbarItem> items{
      switch_of("box", image_icon::box, "Box",
                "Boxes of the truth: what is visible solid, the whole silhouette dashed; and those of trackers, where "
                "results are loaded",
                overlays.box),
      switch_of("path", image_icon::path, "Path", "The path of each intruder, as seen from here through the lens",
                overlays.path),
      switch_of("waypoints", image_icon::waypoints, "Waypoints",
                "Waypoints with their frames. Drag: move at constant distance; with Shift or Alt: nearer and farther. "
                "Double click on the image: add one",
                overlays.waypoints),
      switch_of("horizon", image_icon::horizon, "Horizon",
                "Where the world is level. Drag the line onto the footage's own horizon: its middle up and down, its "
                "ends to tilt it",
                overlays.horizon),
      switch_of("own body", image_icon::own_body, "Own body", "The mask of the aircraft that carries the camera",
                overlays.own_body),
      {.button = {.id = "grid",
                  .icon = image_icon::grid,
                  .label = label_of(overlays.grid),
                  .tooltip = "Lines across the image: thirds, 8 x 6, none",
                  .on = overlays.grid != ImageGrid::none},
       .clicked = [&overlays] { overlays.grid = next(overlays.grid); }},
      gap(),
      {.button = {.id = "wipe",
                  .icon = image_icon::wipe,
                  .label = "Wipe",
                  .tooltip = "Untouched footage left of a line that can be dragged. Hold \\: footage alone",
                  .on = switches.wipe.is_on()},
       .clicked = [&switches] { switches.wipe.toggle(); }},
      gap(),
      {.button = {.id = "fit",
                  .icon = image_icon::fit,
                  .label = "Fit",
                  .tooltip = "The whole image (F or 0)",
                  .on = switches.look.is_fitted()},
       .clicked = [&switches] { switches.look.fit(); }},
      {.button = {.id = "one to one",
                  .label = "1:1",
                  .tooltip = "One pixel of the screen for each of the image (1)",
                  .on = switches.look.zoom() == 1},
       .clicked = [&switches] { switches.look.zoom_to(1, switches.look.room_px() / 2.0); }},
  };
  draw_toolbar(items);
}

}  // namespace sigs::editor
