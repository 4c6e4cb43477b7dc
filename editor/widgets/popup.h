// SPDX-License-Identifier: MIT
#pragma once

namespace sigs::editor {

// In an open popup or list, before it ends: Esc closes it. When it is let go, so that its press finds a popup open
// still and has no other meaning.
void close_by_escape();

}  // namespace sigs::editor
