// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/geometry/image_view.h"
#include "editor/views/context.h"
#include "editor/widgets/toolbar.h"
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
  std::string large_;  // label of the tile that fills the room; "": none
  // The pixel of the frame under the mouse, marked in all linked tiles: as of the update before, and as this one finds
  // it.
  std::optional<cv::Point> pixel_;
  std::optional<cv::Point> next_pixel_;
  std::string pressed_;  // label of the tile that the mouse was pressed on; "": none
  bool panned_ = false;  // the press has become a drag: letting go is no click
};

// The view of how a frame is made: all stages side by side with linked zoom; or the difference between the output and
// the footage, or between two methods. While it is drawn the preview makes the stages too (ViewNeeds).
class StagesView {
 public:
  // Into what is left of the current ImGui window.
  void draw(const ViewContext& context);
  // To be called while it is not drawn: releases its images, as a frame's stages are a dozen frames.
  void forget();

 private:
  // The stages of one method, the output against the footage, or the project's own method against another one.
  enum class Mode { stages, against_input, against_method };

  // Asks for what is to be shown, and takes what is there.
  void request_preview(const ViewContext& context);
  void draw_toolbar_of(const ViewContext& context);
  void draw_method_choice(const ViewContext& context);
  void draw_intruder_choice(const ViewContext& context);
  void draw_gain();
  // To the visible box of the intruder that is looked at; a message where there is none.
  void zoom_to_intruder(const ViewContext& context);
  // Why something is missing or of another frame, over the images.
  void draw_notice(const ViewContext& context, const ScreenRect& rect) const;
  [[nodiscard]] ToolbarItem look_button(const ViewContext& context, const char* label, const char* tooltip, Mode look);
  [[nodiscard]] MethodChoice own_method(const ViewContext& context) const;
  // The method that is looked at, or compared with; never the project's own where two are compared.
  [[nodiscard]] MethodChoice other_method(const ViewContext& context) const;
  // The image whose stages are shown: by the project's own method, or by the other one. Null: not there yet.
  [[nodiscard]] const PreviewImage* image_with_stages(const ViewContext& context) const;
  // Numbers, in the scene, of the intruders that have stages in that image.
  [[nodiscard]] std::vector<int> choices(const ViewContext& context) const;
  // The one whose stages are shown: the chosen one, else the one that is worked on, else the first; none where no
  // intruder has stages.
  [[nodiscard]] std::optional<int> intruder(const ViewContext& context) const;
  // What the grid shows; empty while it is not there.
  [[nodiscard]] std::vector<StageTile> tiles(const ViewContext& context);
  [[nodiscard]] std::vector<StageTile> input_tiles(const PreviewImage& image);
  [[nodiscard]] std::vector<StageTile> method_tiles(const ViewContext& context);

  StageGrid grid_;
  Differences differences_;
  Mode look_ = Mode::stages;
  std::optional<MethodChoice> method_;  // as chosen; none: the project's own
  // As chosen, by the scene's number; none: the one that is worked on.
  std::optional<int> intruder_;
  double gain_ = 8;  // differences are shown that many times as large
  // The newest there was of each: shown until there is a newer one.
  std::shared_ptr<const PreviewImage> staged_;
  std::shared_ptr<const PreviewImage> compared_;
};

}  // namespace sigs::editor
