// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "labels/labels.h"

namespace sigs {

// CVAT for video XML 1.1 (https://docs.cvat.ai/docs/other/xml_format): a track for each intruder that has a box at all,
// since CVAT takes none without. docs/label-formats.md.
// - Frames count from 0 in the exported video. Boxes from edge to edge, the first pixel's left upper corner being (0,
// 0).
// - Every box is a keyframe. Where an intruder vanishes its last box follows once more with outside="1", since CVAT
// draws
//   on until the next.
// - occluded: more than 5 % of what lies in the image is hidden.
// - The own body is left out: a region that holds for a whole video would be a mask track, which CVAT has none of, and
//   one of a label that the task lacks makes CVAT refuse the file.
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_cvat(const std::filesystem::path& path,
                                                             const LabelSequence& sequence);

}  // namespace sigs
