// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/index.h"

namespace sigs {

// The labels of all videos of a dataset put together: one set for each split, in the formats that span videos. They are
// made from the label files of the videos, so a merge needs neither footage nor models.

struct MergeRequest {
  std::filesystem::path dataset;  // the folder in which the videos' folders lie
  std::filesystem::path folder;   // to write into; empty at first
  std::string name;               // of the dataset
  const std::atomic<bool>* cancel = nullptr;
};

// Whether the labels of all videos can be put together: all videos with a format that numbers categories (coco, yolo,
// mot) number the same ones, and videos' names stay different where a format narrows names (mot, kitti, vot).
// Error bad_data, which names two videos.
[[nodiscard]] Result<void> check_labels_agree(const Plan& plan);

// Writes FOLDER/coco/SPLIT.json, FOLDER/csv/SPLIT.csv, ...; docs/dataset.md lists all of them. A format is written
// where at least one video has it. Errors: bad_data where labels are not as this program writes them; cannot_read,
// cannot_create, write_failed, interrupted.
[[nodiscard]] Result<void> merge_labels(const MergeRequest& request, const std::vector<FinishedVideo>& videos);

// The labels of one video in one format.
struct VideoLabels {
  std::string video;           // its name
  std::filesystem::path path;  // the file, or the folder where the format is one
};

// The labels of one split in one format.
struct SplitLabels {
  std::string dataset;  // name of the dataset
  std::string split;
  std::vector<VideoLabels> videos;  // in the plan's order, one at least
};

// One function for each format. Merged records of two videos differ by what the format has for that: ids numbered on
// (coco), the name of the flight (aot) or sequence (csv), a file or folder with the video's name (mot, kitti, vot,
// yolo). Memory grows with the labels of one video, not with the number of videos. Errors: bad_data where a file is not
// as this program writes it, cannot_read, cannot_create, write_failed.

// One file. Ids of videos, tracks, images and annotations are numbered on from video to video; file names of images
// begin at the dataset's folder.
[[nodiscard]] Result<void> merge_coco(const SplitLabels& labels, const std::filesystem::path& file);

// One file with the samples (flights) of all videos.
[[nodiscard]] Result<void> merge_aot(const SplitLabels& labels, const std::filesystem::path& file);

// One file with the rows of all videos under one header.
[[nodiscard]] Result<void> merge_csv(const SplitLabels& labels, const std::filesystem::path& file);

// FOLDER/DATASET-SPLIT/SEQUENCE/ and FOLDER/seqmaps/DATASET-SPLIT.txt, as TrackEval looks for them. Files of the
// videos are linked, so that images take no space twice.
[[nodiscard]] Result<void> merge_mot(const SplitLabels& labels, const std::filesystem::path& folder);

// FOLDER/SPLIT/ with label_02, calib, image_02 and evaluate_tracking.seqmap.training.
[[nodiscard]] Result<void> merge_kitti(const SplitLabels& labels, const std::filesystem::path& folder);

// FOLDER/SPLIT/ with list.txt and the sequences.
[[nodiscard]] Result<void> merge_vot(const SplitLabels& labels, const std::filesystem::path& folder);

// FOLDER/data.yaml, which names the image folders of all splits where they are, in the videos' own folders. `from` is
// the path from data.yaml to the dataset's folder.
[[nodiscard]] Result<void> merge_yolo(const std::vector<SplitLabels>& splits, const std::filesystem::path& folder,
                                      const std::string& from);

}  // namespace sigs
