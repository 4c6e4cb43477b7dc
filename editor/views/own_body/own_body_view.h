// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "editor/views/context.h"
#include "editor/views/own_body/own_body_images.h"
#include "editor/views/own_body/own_body_panel.h"
#include "editor/views/own_body/own_body_session.h"
#include "editor/views/stages/stage_grid.h"
#include "editor/widgets/toolbar.h"
#include "editor/widgets/zoomable_image.h"

namespace sigs::editor {

enum class CanvasMode { over_footage, mask_alone, confidence };

// The footage with the mask over it, or one of the others instead: zoomed, panned and painted on.
class OwnBodyCanvas {
 public:
  void draw(const ViewContext& context, OwnBodySession& session, const ScreenRect& rect, CanvasMode look);
  // The line below: what the mouse is over.
  void draw_readout(const OwnBodySession& session) const;

  [[nodiscard]] ZoomableImage& look() { return look_; }
  [[nodiscard]] double radius_px() const { return radius_px_; }
  void set_radius_px(double radius_px) { radius_px_ = radius_px; }
  [[nodiscard]] bool erases() const { return erases_; }
  void set_erases(bool erases) { erases_ = erases; }

 private:
  [[nodiscard]] Brush brush(const ViewContext& context) const;
  void handle_keys();
  void handle_mouse(const ViewContext& context, OwnBodySession& session, const ImageCanvas& canvas, bool paints);
  void draw_layers(const ViewContext& context, const OwnBodySession& session, const ImageCanvas& canvas,
                   CanvasMode look);
  void draw_confidence(const ViewContext& context, const OwnBodySession& session, const ImageCanvas& canvas);
  void draw_brush(const ViewContext& context, const ImageCanvas& canvas) const;

  ZoomableImage look_;
  MaskTiles tiles_;
  std::shared_ptr<const OwnBody> shown_confidence_of_;
  cv::Mat confidence_;
  double radius_px_ = 20;
  bool erases_ = false;
  bool hovered_ = false;
  bool pans_ = false;
  std::optional<cv::Point> pixel_;  // under the mouse
};

// Where the own body's mask is made: found in the footage, looked at step by step, painted, saved and used.
class OwnBodyView {
 public:
  // Into what is left of the current ImGui window.
  void draw(const ViewContext& context, OwnBodySession& session);

 private:
  enum class Mode { paint, mask, confidence, stages };

  [[nodiscard]] bool paints() const { return look_ == Mode::paint || look_ == Mode::mask; }
  [[nodiscard]] ToolbarItem look_button(const ViewContext& context, const char* label, const char* tooltip, Mode look);
  void add_brush_items(std::vector<ToolbarItem>& items, const ViewContext& context, MaskPainting& painting);
  void draw_radius(const ViewContext& context);
  void draw_toolbar_of(const ViewContext& context, OwnBodySession& session);
  void draw_image_of(const ViewContext& context, OwnBodySession& session, const ScreenRect& rect);
  void draw_stages(const ViewContext& context, const OwnBodySession& session, const ScreenRect& rect);
  void handle_undo(const ViewContext& context, MaskPainting& painting, const ScreenRect& worked_in);

  Mode look_ = Mode::paint;
  OwnBodyCanvas canvas_;
  OwnBodyPanel panel_;
  StageGrid grid_;
  bool is_worked_in_ = false;  // the last press was on the image or its toolbar, or gave the painting another start
  int last_update_ = -1;       // in which it was drawn
};

}  // namespace sigs::editor
