// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/geometry/image_view.h"
#include "editor/widgets/zoomable_image.h"
#include "frame/compose_frame.h"

namespace sigs::editor {

// One image of a grid of them. Labels of one grid differ: a tile is known by its label from update to update.
struct StageTile {
  std::string label;
  std::string tooltip;
  // CV_8UC3 (BGR) or CV_8UC1; its samples must not change, for textures know it by them.
  cv::Mat image;
};

// What a stage's name says: "1_warped" is "warped" of the scene's intruder 1, "warped" and "output" are nobody's.
struct StageName {
  std::optional<int> intruder;
  std::string stage;
};
[[nodiscard]] StageName stage_name(const std::string& name);

// The scene's numbers of the intruders that have stages of their own, each once, rising.
[[nodiscard]] std::vector<int> intruders_of(const std::vector<Stage>& stages);

// The stages of one intruder and those of the whole frame, in the order in which they were made, labelled as in the
// paper's figure 4. None: every stage whose name has no number.
[[nodiscard]] std::vector<StageTile> stage_tiles(const std::vector<Stage>& stages, std::optional<int> intruder);

// How much two images differ, times a gain, saturated, black where they are equal; of the kind of a and b. Empty where
// their sizes or kinds differ, or both are empty.
[[nodiscard]] cv::Mat difference(const cv::Mat& a, const cv::Mat& b, double gain);

// The same, made once and kept for the last pair and gain, so that it is not computed and uploaded in every update.
// Images are known by the address of their samples.
class Differences {
 public:
  [[nodiscard]] cv::Mat of(const cv::Mat& a, const cv::Mat& b, double gain);

 private:
  struct CachedDifference {
    cv::Mat a;  // kept, so that their addresses stay theirs
    cv::Mat b;
    double gain = 1;
    cv::Mat image;
  };
  std::vector<CachedDifference> made_;
};

// How many columns and rows give images of a shape the most room.
struct GridShape {
  int columns = 1;
  int rows = 1;
};
// The arrangement of `count` images of one shape in a room that shows them largest. label_px: height that each tile
// needs besides its image. Sizes in screen pixels but for image_px, of which only the shape counts.
[[nodiscard]] GridShape grid_shape(int count, const glm::dvec2& image_px, const glm::dvec2& room_px, double label_px);

// Images side by side, each under its label. Those of one size, the frame's, are zoomed and panned as one, and the
// pixel under the mouse is marked in all of them; the others are shown whole. A click makes one large, a click more
// or Escape brings the others back.
class StageGrid {
 public:
  // In `rect` of the screen, once per update. frame_px: size of the frame; tiles of this size are linked.
  void draw(std::span<const StageTile> tiles, const cv::Size& frame_px, const ScreenRect& rect, Textures& textures);

  void fit() { look_.fit(); }
  // Zooms all linked tiles to a part of the frame, in its pixels.
  void show(const Box& part) { look_.show(part); }
  void zoom_to_exact();
  [[nodiscard]] const ZoomableImage& look() const { return look_; }
  // Brings all tiles back where one is large.
  void show_all() { large_.clear(); }
  // Before drawing: Escape brings all back. Returns whether it was pressed for that, so that nobody else takes the key.
  [[nodiscard]] bool handle_escape();

 private:
  void draw_tile(const StageTile& tile, const cv::Size& frame_px, const ScreenRect& rect, Textures& textures);
  void draw_image_of(const StageTile& tile, bool linked, const ScreenRect& room, Textures& textures);
  void draw_head(const StageTile& tile, bool linked, const ScreenRect& rect) const;
  void handle_mouse(const StageTile& tile, bool linked, const ScreenRect& room);

  ZoomableImage look_;
  // Label of the tile that fills the room; "": none.
  std::string large_;
  // The pixel of the frame under the mouse, marked in all linked tiles: as of the update before, and as this one finds
  // it.
  std::optional<cv::Point> pixel_;
  std::optional<cv::Point> next_pixel_;
  // Label of the tile that the mouse was pressed on; "": none.
  std::string pressed_;
  // The press has become a drag: letting go is no click.
  bool panned_ = false;
};

}  // namespace sigs::editor
