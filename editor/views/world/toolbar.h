// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "editor/views/world/look.h"

namespace sigs::editor {

// What was asked for with a button; the rest it does itself (projection, snapping).
struct WorldToolbarAnswer {
  std::optional<WorldStand> stand;
  bool frame_all = false;
};

// One row over the world view.
[[nodiscard]] WorldToolbarAnswer draw_world_toolbar(WorldLook& look);

}  // namespace sigs::editor
