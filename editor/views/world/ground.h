// SPDX-License-Identifier: MIT
#pragma once

#include "editor/views/world/canvas.h"

namespace sigs::editor {

// The ground ruled in metres; level with it, one line with its metres.
void draw_ground(WorldCanvas& canvas);
// How far its lines are from the world's origin, at the edges, in the axis' colour; after what has a better claim to
// room.
void draw_ground_labels(WorldCanvas& canvas);
// The world's axes in the lower left corner.
void draw_axes(WorldCanvas& canvas);

}  // namespace sigs::editor
