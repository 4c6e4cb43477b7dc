// SPDX-License-Identifier: MIT
#pragma once

#include "editor/document/settings.h"
#include "editor/preview/background_job.h"
#include "editor/views/context.h"

namespace sigs::editor {

// What the menu bar shows beside the menus.
struct MenuBarContent {
  bool has_project = false;
  const ExportState& exporting;
};

// The bar along the window's upper edge: menus, the project's name with a dot where something is unsaved, the number
// of its problems, and a running export. Which panels are shown it changes in the settings at once.
void draw_menu_bar(const ViewContext& context, const MenuBarContent& content, Settings& settings);

}  // namespace sigs::editor
