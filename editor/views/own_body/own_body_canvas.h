// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "editor/views/own_body/mask_tiles.h"
#include "editor/views/own_body/own_body_work.h"
#include "editor/views/studio.h"
#include "editor/widgets/zoomable_picture.h"

namespace sigs::editor {

enum class CanvasLook { over_footage, mask_alone, confidence };

// The footage with the mask over it, or one of the others instead: zoomed, panned and painted on.
class OwnBodyCanvas {
 public:
  void draw(const Studio& studio, OwnBodyWork& work, const ScreenRect& rect, CanvasLook look);
  // The line below: what the mouse is over.
  void draw_readout(const OwnBodyWork& work) const;

  [[nodiscard]] ZoomablePicture& look() { return look_; }
  [[nodiscard]] double radius_px() const { return radius_px_; }
  void set_radius_px(double radius_px) { radius_px_ = radius_px; }
  [[nodiscard]] bool erases() const { return erases_; }
  void set_erases(bool erases) { erases_ = erases; }

 private:
  [[nodiscard]] Brush brush(const Studio& studio) const;
  void take_keys();
  void take_mouse(const Studio& studio, OwnBodyWork& work, const PictureCanvas& canvas, bool paints);
  void draw_layers(const Studio& studio, const OwnBodyWork& work, const PictureCanvas& canvas, CanvasLook look);
  void draw_confidence(const Studio& studio, const OwnBodyWork& work, const PictureCanvas& canvas);
  void draw_brush(const Studio& studio, const PictureCanvas& canvas) const;

  ZoomablePicture look_;
  MaskTiles tiles_;
  std::shared_ptr<const OwnBody> shown_confidence_of_;
  cv::Mat confidence_;
  double radius_px_ = 20;
  bool erases_ = false;
  bool hovered_ = false;
  bool pans_ = false;
  std::optional<cv::Point> pixel_;  // under the mouse
};

}  // namespace sigs::editor
