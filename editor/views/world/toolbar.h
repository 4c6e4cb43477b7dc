// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "editor/views/world/view_presets.h"

namespace sigs::editor {

// What was asked for with a button; the rest it does itself (projection, snapping).
struct WorldToolbarResult {
  std::optional<WorldViewPreset> preset;
  bool frame_all = false;
};

// One row over the world view.
[[nodiscard]] WorldToolbarResult draw_world_toolbar(WorldViewState& look);

}  // namespace sigs::editor
