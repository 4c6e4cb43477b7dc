// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string_view>

#include "labels/labels.h"

namespace sigs {

inline constexpr std::array<std::string_view, 8> kVotFiles{
    "list.txt",        "*/sequence",         "*/groundtruth.txt",        "*/absence.tag",
    "*/occlusion.tag", "*/distance_m.value", "*/visible_fraction.value", "*/color/#.png"};

// Folder of sequences as the VOT toolkit reads it (https://github.com/votchallenge/toolkit), one for each intruder:
// NAME, or NAME-0, NAME-1, ... where there are several. docs/label-formats.md.
//   list.txt                  those in which the intruder appears
//   NAME/sequence             lines key=value
//   NAME/groundtruth.txt      a line for each frame: x,y,width,height from 0; nan,nan,nan,nan: no label
//   NAME/*.tag, *.value       a line for each frame: absence, occlusion; distance_m, visible_fraction
//   NAME/color/00000001.png   where images are written
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_vot(const std::filesystem::path& path,
                                                            const LabelSequence& sequence);

}  // namespace sigs
