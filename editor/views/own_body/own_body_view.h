// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "editor/document/field_edits.h"
#include "editor/views/context.h"
#include "editor/views/inspector/problems.h"
#include "editor/views/own_body/own_body_images.h"
#include "editor/views/own_body/own_body_session.h"
#include "editor/views/stages/stages_view.h"
#include "editor/widgets/toolbar.h"
#include "editor/widgets/zoomable_image.h"

namespace sigs::editor {

// Beside the canvas: how to detect, what came of it, what to paint on, and where the mask goes. Settings of the
// detection are changed by edits of the project; all else goes to the session.
class OwnBodyPanel {
 public:
  // Into what is left of the current ImGui window. True in updates in which the painting was given another start.
  [[nodiscard]] bool draw(const ViewContext& context, OwnBodySession& session);

 private:
  // The project's fields of the method that is chosen.
  void draw_settings(const ViewContext& context);
  // A button that starts it, progress while it runs, and what the last run found with cautions about it.
  void draw_detection(const ViewContext& context, OwnBodySession& session) const;
  void draw_running(const ViewContext& context, OwnBodySession& session) const;
  void draw_found(const ViewContext& context, const DetectionState& state) const;
  // Buttons that replace the painting. True: one of them did.
  [[nodiscard]] bool draw_start_from(const ViewContext& context, OwnBodySession& session) const;
  // Where the painting is of another size than the footage.
  void draw_misfit(const ViewContext& context, OwnBodySession& session) const;
  // Whether the mask is on disk and used, and the buttons that save it.
  void draw_file(const ViewContext& context, OwnBodySession& session);
  // The question whether the project's own file may be replaced.
  void draw_replacing(const ViewContext& context, OwnBodySession& session);

  ProblemList problems_;
  RowMemory memory_;
  bool asks_to_replace_ = false;  // the question of draw_replacing() is open
};

// The mask as a tint over the footage, the mask alone (white: own body), or the detection's confidence.
enum class CanvasMode { over_footage, mask_alone, confidence };

// The footage with the mask over it, or one of the others instead: zoomed, panned and painted on. Strokes go into the
// session's painting at once; they are no edits of the project. Pixels are those of the footage.
class OwnBodyCanvas {
 public:
  // Into `rect` of the screen, once per update; takes the mouse and the keys B, E, [ and ] while the mouse is over it.
  void draw(const ViewContext& context, OwnBodySession& session, const ScreenRect& rect, CanvasMode look);
  // The line below: position, mask and confidence of the pixel that the mouse is over, at the right zoom and size. Into
  // what is left of the current ImGui window.
  void draw_readout(const OwnBodySession& session) const;

  // Zoom and place of the image, for the toolbar.
  [[nodiscard]] ZoomableImage& look() { return look_; }
  // Of the brush, kMinRadius_px .. kMaxRadius_px.
  [[nodiscard]] double radius_px() const { return radius_px_; }
  void set_radius_px(double radius_px) { radius_px_ = radius_px; }
  // Whether the brush takes away, unless Shift is held.
  [[nodiscard]] bool erases() const { return erases_; }
  void set_erases(bool erases) { erases_ = erases; }

 private:
  // As it is in this update: with the soft edge of the project's settings, and turned round by Shift.
  [[nodiscard]] Brush brush(const ViewContext& context) const;
  void handle_keys();
  // Strokes and panning. paints: whether a left drag paints.
  void handle_mouse(const ViewContext& context, OwnBodySession& session, const ImageCanvas& canvas, bool paints);
  // The footage, and over it what `look` says; the footage alone while the backslash key is held.
  void draw_layers(const ViewContext& context, const OwnBodySession& session, const ImageCanvas& canvas,
                   CanvasMode look);
  void draw_confidence(const ViewContext& context, const OwnBodySession& session, const ImageCanvas& canvas);
  void draw_brush(const ViewContext& context, const ImageCanvas& canvas) const;

  ZoomableImage look_;
  MaskTiles tiles_;
  // The detection that confidence_ is the image of; null: none yet.
  std::shared_ptr<const OwnBody> shown_confidence_of_;
  cv::Mat confidence_;
  double radius_px_ = 20;
  bool erases_ = false;
  bool hovered_ = false;            // the mouse was over the canvas in this update
  bool pans_ = false;               // the press that lasts moves the image instead of painting
  std::optional<cv::Point> pixel_;  // under the mouse; none: beside the image
};

// Where the own body's mask is made: found in the footage, looked at step by step, painted, saved and used. A toolbar
// above the image, a panel beside it. What it shows and changes is in the session, which outlives it.
class OwnBodyView {
 public:
  // Once per update in which it is shown, into what is left of the current ImGui window. Also has the session follow
  // the document.
  void draw(const ViewContext& context, OwnBodySession& session);

 private:
  // What is in the image's place; paint and mask can be painted on.
  enum class Mode { paint, mask, confidence, stages };

  [[nodiscard]] bool paints() const { return look_ == Mode::paint || look_ == Mode::mask; }
  // The button of one mode.
  [[nodiscard]] ToolbarItem look_button(const ViewContext& context, const char* label, const char* tooltip, Mode look);
  void add_brush_items(std::vector<ToolbarItem>& items, const ViewContext& context, MaskPainting& painting);
  // The number field of the brush's radius.
  void draw_radius(const ViewContext& context);
  void draw_toolbar_of(const ViewContext& context, OwnBodySession& session);
  void draw_image_of(const ViewContext& context, OwnBodySession& session, const ScreenRect& rect);
  void draw_stages(const ViewContext& context, const OwnBodySession& session, const ScreenRect& rect);
  // Undo and redo count strokes while the last press was in `worked_in`; otherwise the document's steps.
  void handle_undo(const ViewContext& context, MaskPainting& painting, const ScreenRect& worked_in);

  Mode look_ = Mode::paint;
  OwnBodyCanvas canvas_;
  OwnBodyPanel panel_;
  StageGrid grid_;
  // The last press was on the image or its toolbar, or gave the painting another start.
  bool is_worked_in_ = false;
  int last_update_ = -1;  // number of the ImGui frame in which it was drawn last
};

}  // namespace sigs::editor
