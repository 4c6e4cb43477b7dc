// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/result.h"
#include "evaluation/readers/clip_truth.h"
#include "evaluation/readers/results.h"

namespace sigs {

// The truth in files that other programs have written, or SIGS in their layouts. docs/evaluation-reference.md says what
// is read of each and which boxes are ignored, docs/evaluation.md which figures need what a layout does not have.

// A clip of such a file or folder.
struct TruthClip {
  std::string name;  // of the video, flight or sequence; results' files are called so
  ClipTruth truth;
  FramesOfImages images;             // what the file calls the frames
  std::set<std::string> categories;  // classes of all its boxes
};

// What a layout may not say.
struct TruthOptions {
  cv::Size size_px;                  // of the images (yolo); empty: read from the images
  double rate_hz = 0;                // frames a second; 0: as the file says. It overrides what the file says
  std::vector<std::string> classes;  // only objects of these count, others are ignored boxes; empty: all count
  bool stills = false;               // images are no frames of a video: in order of their names, gaps allowed
};

// Reads all clips of a truth, in order of their names:
//   FILE.json    an object with "samples" (aot), or with "images" and "annotations" (coco)
//   FOLDER       with gt/gt.txt, or with folders that have it (mot); with labels/ (yolo)
// Distances that a file does not state are NaN, ClipTruth::has_ids and has_times say what else is missing.
// Errors: cannot_read; bad_data with file and place: of no such layout, numbers that are missing, not finite or out of
// range, boxes without area, one object twice in a frame, frames that are missing or twice, classes that no box has.
[[nodiscard]] Result<std::vector<TruthClip>> read_truth_clips(const std::filesystem::path& path,
                                                              const TruthOptions& options = {});

// Results of all clips in one file of layout aot or coco, which calls images as the truth does: those of each clip, in
// order. Errors as read_results(); a layout without names of images.
[[nodiscard]] Result<std::vector<Results>> read_shared_results(const std::filesystem::path& path,
                                                               const std::vector<const TruthClip*>& clips,
                                                               ResultsFormat format);

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
