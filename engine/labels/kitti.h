// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string_view>

#include "labels/labels.h"

namespace sigs {

inline constexpr std::array<std::string_view, 4> kKittiFiles{"label_02/*.txt", "calib/*.txt",
                                                             "evaluate_tracking.seqmap.training", "image_02/*/#.png"};

// Folder of the KITTI tracking benchmark (https://www.cvlibs.net/datasets/kitti/eval_tracking.php).
// docs/label-formats.md.
//   label_02/NAME.txt            frame from 0, id, type, truncated, occluded, alpha, left top right bottom (edges, from
//                                0), height width length, x y z, rotation_y (labels/kitti_box.h)
//   calib/NAME.txt               where a camera is known: the pinhole part of its lens
//   image_02/NAME/000000.png     where images are written
//   evaluate_tracking.seqmap.training  TrackEval's list of sequences
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_kitti(const std::filesystem::path& path,
                                                              const LabelSequence& sequence);

}  // namespace sigs
