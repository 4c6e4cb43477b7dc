// SPDX-License-Identifier: MIT
#pragma once

#include "editor/views/world/scene.h"

namespace sigs::editor {

// The volumes of well clear around the camera at the playhead, as upright cylinders of radius DMOD (or HMD, if larger)
// and of ZTHR above and below: those of export.encounter, else small-uas. Red while an intruder has lost it, which
// modified tau may cause outside of the cylinder.
void draw_volumes(WorldCanvas& canvas, const WorldContext& world);

}  // namespace sigs::editor
