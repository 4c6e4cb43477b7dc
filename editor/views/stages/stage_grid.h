// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/geometry/image_view.h"
#include "editor/views/stages/stage_tiles.h"
#include "editor/widgets/image_canvas.h"
#include "editor/widgets/zoomable_image.h"

namespace sigs::editor {

// How many columns and rows give images of a shape the most room.
struct GridShape {
  int columns = 1;
  int rows = 1;
};
[[nodiscard]] GridShape grid_shape(int count, const glm::dvec2& image_px, const glm::dvec2& room_px, double label_px);

// Images side by side, each under its label. Those of one size, the frame's, are zoomed and panned as one, and the
// pixel under the mouse is marked in all of them; the others are shown whole. A click makes one large, a click more
// or Escape brings the others back.
class StageGrid {
 public:
  void draw(std::span<const StageTile> tiles, const cv::Size& frame_px, const ScreenRect& rect, Textures& textures);

  void fit() { look_.fit(); }
  void show(const Box& part) { look_.show(part); }
  void zoom_to_exact();
  [[nodiscard]] const ZoomableImage& look() const { return look_; }
  void show_all() { large_.clear(); }
  // Before drawing: Escape brings all back. Whether it was pressed for that.
  [[nodiscard]] bool handle_escape();

 private:
  void draw_tile(const StageTile& tile, const cv::Size& frame_px, const ScreenRect& rect, Textures& textures);
  void draw_image_of(const StageTile& tile, bool linked, const ScreenRect& room, Textures& textures);
  void draw_head(const StageTile& tile, bool linked, const ScreenRect& rect) const;
  void handle_mouse(const StageTile& tile, bool linked, const ScreenRect& room);

  ZoomableImage look_;
  std::string large_;               // label of the tile that fills the room; "": none
  std::optional<cv::Point> pixel_;  // marked, of the frame
  std::optional<cv::Point> next_pixel_;
  std::string pressed_;  // label of the tile that the mouse was pressed on
  bool panned_ = false;
};

}  // namespace sigs::editor
