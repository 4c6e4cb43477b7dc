// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "editor/views/context.h"

namespace sigs::editor {

// A key and what it does, for the help page: what handle_keys follows, and below that what views take themselves while
// the mouse is over them.
struct Shortcut {
  const char* group;
  const char* keys;
  const char* what;
};
// In the order of the help page; lines of one group follow each other. The texts are literals.
[[nodiscard]] std::span<const Shortcut> shortcuts();

// Asks for what the keys pressed in this update mean. Not while text is typed or a dialog is open; while the mouse
// holds something only those that go and play; without a project those of the program alone.
void handle_keys(const ViewContext& context, bool has_project);

}  // namespace sigs::editor
