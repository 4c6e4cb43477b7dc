// SPDX-License-Identifier: MIT
#pragma once

#include "editor/document/document.h"
#include "editor/document/settings.h"
#include "editor/preview/preview_output.h"
#include "editor/preview/scoring.h"
#include "editor/widgets/textures.h"
#include "editor/widgets/ui_probe.h"

namespace sigs::editor {

// What the views that are drawn would like to have made; asked anew each update.
struct ViewNeeds {
  bool footage = false;  // the untouched frame too
  bool stages = false;
  std::optional<MethodChoice> compare_with;
  std::optional<PreviewRequest::Turntable> turntable;
  bool own_undo = false;    // the view that is worked in takes undo and redo itself
  bool own_escape = false;  // a view has taken Escape
};

// What a view draws from and where it puts what the person wants. A view changes nothing else.
struct ViewContext {
  const Document& document;
  const PreviewOutput& shown;
  const Settings& settings;
  Textures& textures;
  Edits& edits;
  ViewNeeds& needs;
  UiProbe& ui_probe;
  bool playing = false;
  double speed = 0;                // of playing, 0 while it stands
  const Scored* scored = nullptr;  // null: no results of trackers are loaded

  [[nodiscard]] const Project& project() const { return document.project(); }
};

}  // namespace sigs::editor
