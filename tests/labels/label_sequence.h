// SPDX-License-Identifier: MIT
#pragma once

#include "labels/label_writing.h"

namespace sigs::test::labels {

// A sequence of images of 64 x 48 px, frames 100 to `last` at 30000/1001 a second, called "crossing", with two
// intruders: 0, an "airplane", and 1, a "glider".
[[nodiscard]] LabelSequence label_sequence(int last = 100);

// Frames from 100 on.
[[nodiscard]] std::vector<FrameTruth> frames_of(const std::vector<std::vector<IntruderTruth>>& intruders);

// Names that formats have to quote or escape, in UTF-8.
[[nodiscard]] std::vector<std::string> special_names();

}  // namespace sigs::test::labels
