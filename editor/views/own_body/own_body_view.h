// SPDX-License-Identifier: MIT
#pragma once

#include "editor/views/own_body/own_body_canvas.h"
#include "editor/views/own_body/own_body_panel.h"
#include "editor/views/stages/stage_grid.h"
#include "editor/widgets/toolbar.h"

namespace sigs::editor {

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
