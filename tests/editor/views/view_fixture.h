// SPDX-License-Identifier: MIT
#pragma once

#include "editor/document/document.h"
#include "editor/views/context.h"

namespace sigs::editor {

// What a view is given, without a window and without files. Tests derive from it.
struct ViewFixture {
  explicit ViewFixture(const Project& project) : document(project) {}
  ViewFixture(const ViewFixture&) = delete;
  ViewFixture& operator=(const ViewFixture&) = delete;

  void apply() { document.apply(edits.take_edits()); }

  Document document;
  PreviewOutput shown;
  Settings settings;
  Textures textures;
  Edits edits;
  ViewNeeds needs;
  UiProbe ui_probe;
  ViewContext context{document, shown, settings, textures, edits, needs, ui_probe};
};

}  // namespace sigs::editor
