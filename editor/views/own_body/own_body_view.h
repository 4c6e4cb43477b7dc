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
  void draw(const Studio& studio, OwnBodyWork& work);

 private:
  enum class Look { paint, mask, confidence, stages };

  [[nodiscard]] bool paints() const { return look_ == Look::paint || look_ == Look::mask; }
  [[nodiscard]] ToolbarItem look_button(const Studio& studio, const char* label, const char* tooltip, Look look);
  void add_brush_items(std::vector<ToolbarItem>& items, const Studio& studio, MaskPainting& painting);
  void draw_radius(const Studio& studio);
  void draw_toolbar_of(const Studio& studio, OwnBodyWork& work);
  void draw_picture_of(const Studio& studio, OwnBodyWork& work, const ScreenRect& rect);
  void draw_stages(const Studio& studio, const OwnBodyWork& work, const ScreenRect& rect);
  void take_undo(const Studio& studio, MaskPainting& painting, const ScreenRect& worked_in);

  Look look_ = Look::paint;
  OwnBodyCanvas canvas_;
  OwnBodyPanel panel_;
  StageGrid grid_;
  bool is_worked_in_ = false;  // the last press was on the picture or its toolbar, or gave the painting another start
  int last_turn_ = -1;         // in which it was drawn
};

}  // namespace sigs::editor
