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
  // The decoded frame without intruders.
  bool footage = false;
  // The images of all stages of the frame.
  bool stages = false;
  // The frame by this method too.
  std::optional<MethodChoice> compare_with;
  // An image of one intruder's model.
  std::optional<PreviewRequest::Turntable> turntable;
  // The view that is worked in takes undo and redo itself: the program's own keys for them do nothing in this update.
  bool own_undo = false;
  // A view has taken Escape.
  bool own_escape = false;
};

// The input and output of a view in one update. Input: the document, the newest preview, the settings. Output: changes
// and requests of the user in `edits`, what the preview is to compute in `needs`, named places for tests in `ui_probe`.
// A view changes nothing else but its own state (zoom, which overlay is on). It is valid while the update draws:
// functions that are called later must not keep it.
struct ViewContext {
  const Document& document;
  // May be of an older revision than the document, and empty at first.
  const PreviewOutput& shown;
  const Settings& settings;
  Textures& textures;
  // Outlives the update, so what an AskForFile calls later may keep a reference to it.
  Edits& edits;
  ViewNeeds& needs;
  UiProbe& ui_probe;
  bool playing = false;
  // Of playing, times the footage's own; negative: backwards; 0 while it pauses.
  double speed = 0;
  // Null: no results of trackers are loaded.
  const Scored* scored = nullptr;

  [[nodiscard]] const Project& project() const { return document.project(); }
};

}  // namespace sigs::editor
