// SPDX-License-Identifier: MIT
#pragma once

#include "editor/document/document.h"
#include "editor/document/settings.h"
#include "editor/preview/preview_output.h"
#include "editor/preview/scoring.h"
#include "editor/widgets/textures.h"
#include "editor/widgets/ui_probe.h"

namespace sigs::editor {

// What the views that are drawn in this update need from the preview. Empty at the start of each update; each view sets
// what it needs while it draws.
struct ViewNeeds {
  bool footage = false;  // the decoded frame without intruders
  bool stages = false;
  std::optional<MethodChoice> compare_with;
  std::optional<PreviewRequest::Turntable> turntable;
  bool own_undo = false;    // the view that is worked in takes undo and redo itself
  bool own_escape = false;  // a view has taken Escape
};

// The input and output of a view in one update. Input: the document, the newest preview, the settings. Output: changes
// and requests of the user in `edits`, what the preview is to compute in `needs`, named places for tests in `ui_probe`.
// A view changes nothing else but its own state (zoom, which overlay is on).
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
