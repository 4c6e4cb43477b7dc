// SPDX-License-Identifier: MIT
#pragma once

#include "truth/annotation.h"

namespace sigs {

// Of what lies in the image of an intruder, the share that the own body or nearer intruders hide: 0 to 1. 0 where
// nothing of it lies there.
[[nodiscard]] double occluded_fraction(const IntruderTruth& truth);

// Hidden by more than a twentieth, as Pascal VOC's guidelines (2008 and later) draw the line: softer than that are the
// edges of masks.
[[nodiscard]] bool is_occluded(const IntruderTruth& truth);

}  // namespace sigs
