// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "evaluation/readers/clip_truth.h"

namespace sigs {

// The truth of a sequence of the tracking benchmarks OTB and VOT: a folder with boxes in text and images.

struct SequenceTruth {
  std::string name;  // of the folder
  ClipTruth
      truth;  // frames from 0; a target for each file of boxes; NaN distances; times NaN and rate 0 where not stated
  std::filesystem::path images;  // folder of images or video; empty: the folder has neither
};

// Whether a folder has groundtruth_rect.txt, groundtruth_rect.1.txt, ... (otb) or groundtruth.txt (vot).
[[nodiscard]] bool is_sequence_folder(const std::filesystem::path& folder);

// The folders of this kind in a folder, by name; none where it cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> sequences_in(const std::filesystem::path& folder);

// Reads one. Boxes of otb count pixels from 1, those of vot from 0; vot may have polygons of 4 corners or more, of
// which the bounding box counts. A box of NaN, or without width and height, says that the target is absent. Of vot
// also `sequence` (size, frame rate) and visible_fraction.value and distance_m.value, which SIGS writes.
// Errors: cannot_read; bad_data with file and line: no numbers, another number of columns, a negative size, masks in
// VOT's encoding, files of different lengths, no line.
[[nodiscard]] Result<SequenceTruth> read_sequence_truth(const std::filesystem::path& folder);

}  // namespace sigs
