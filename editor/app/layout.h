// SPDX-License-Identifier: MIT
#pragma once

#include "editor/document/settings.h"
#include "editor/views/first_steps.h"
#include "editor/views/inspector/inspector_view.h"
#include "editor/views/stages/stages_view.h"
#include "editor/views/timeline/timeline_view.h"
#include "editor/views/viewport/viewport_view.h"
#include "editor/views/world/world_view.h"

namespace sigs::editor {

// Which panel lies where: footage and world side by side above the timeline, the inspector at the right. The lines
// between them can be dragged; their places are kept in the settings.
class Layout {
 public:
  // Fills the window below the menu bar.
  void draw(const Studio& studio, Settings& settings);

 private:
  void draw_pictures(const Studio& studio, Settings& settings);

  ViewportView viewport_;
  WorldView world_;
  TimelineView timeline_;
  InspectorView inspector_;
  StagesView stages_;
  FirstSteps first_steps_;
};

}  // namespace sigs::editor
