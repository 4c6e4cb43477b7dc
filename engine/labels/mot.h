// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string_view>

#include "labels/labels.h"

namespace sigs {

inline constexpr std::array<std::string_view, 4> kMotFiles{"seqmaps/*.txt", "*/seqinfo.ini", "*/gt/gt.txt",
                                                           "*/img1/#.png"};

// MOTChallenge folder (https://motchallenge.net/instructions) as TrackEval reads it. docs/label-formats.md.
//   seqmaps/NAME.txt      the list of sequences
//   NAME/seqinfo.ini      the sequence, and which class is which category
//   NAME/gt/gt.txt        frame, id, left, top, width, height, 1 to count or 0 to ignore, class, visible fraction;
//   frames,
//                         ids, pixels and classes from 1
//   NAME/img1/000001.png  where images are written
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_mot(const std::filesystem::path& path,
                                                            const LabelSequence& sequence);

}  // namespace sigs
