// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"

namespace sigs {

// The labels of one video in one format.
struct VideoLabels {
  std::string video;           // its name
  std::filesystem::path path;  // the file or the folder
};

// The labels of one split.
struct SplitLabels {
  std::string dataset;  // its name
  std::string split;
  std::vector<VideoLabels> videos;  // in the plan's order, one at least
};

// Each puts the labels of several videos together, reading them line by line, so that memory does not grow with them.
// Errors: bad_data where a file is not as this program writes it, cannot_read, cannot_create, write_failed.

// One file, ids numbered on from video to video. Names of images start from the dataset's folder.
[[nodiscard]] Result<void> merge_coco(const SplitLabels& labels, const std::filesystem::path& file);

// One file with the samples (flights) of all.
[[nodiscard]] Result<void> merge_aot(const SplitLabels& labels, const std::filesystem::path& file);

// One file, its header once.
[[nodiscard]] Result<void> merge_csv(const SplitLabels& labels, const std::filesystem::path& file);

// folder/DATASET-SPLIT/SEQUENCE/ and folder/seqmaps/DATASET-SPLIT.txt, as TrackEval looks for them.
[[nodiscard]] Result<void> merge_mot(const SplitLabels& labels, const std::filesystem::path& folder);

// folder/SPLIT/ with label_02, calib, image_02 and evaluate_tracking.seqmap.training.
[[nodiscard]] Result<void> merge_kitti(const SplitLabels& labels, const std::filesystem::path& folder);

// folder/SPLIT/ with list.txt and the sequences.
[[nodiscard]] Result<void> merge_vot(const SplitLabels& labels, const std::filesystem::path& folder);

// folder/data.yaml, which names the images of all splits where they lie, in the videos' own folders. `from` is the
// dataset's folder as seen from data.yaml.
[[nodiscard]] Result<void> merge_yolo(const std::vector<SplitLabels>& splits, const std::filesystem::path& folder,
                                      const std::string& from);

}  // namespace sigs
