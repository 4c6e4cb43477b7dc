// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string_view>

#include "labels/labels.h"

namespace sigs {

inline constexpr std::array<std::string_view, 4> kYoloFiles{"data.yaml", "images/*/frame_#.png", "labels/*/frame_#.txt",
                                                            "labels/*.cache"};

// YOLO folder as Ultralytics reads it (https://docs.ultralytics.com/datasets/detect). docs/label-formats.md.
//   data.yaml                     classes from 0; no `path`, so paths are relative to it
//   images/NAME/frame_000123.png  where images are written
//   labels/NAME/frame_000123.txt  `class x y width height` of a box; empty where there is none, which makes the image
//                                 one of background. x and y are its centre; all are shares of the image's width or
//                                 height, the image reaching from 0 to 1
// Between images/ and labels/ the paths are the same, since readers find the one from the other. NAME lets folders of
// several videos be laid together.
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_yolo(const std::filesystem::path& path,
                                                             const LabelSequence& sequence);

}  // namespace sigs
