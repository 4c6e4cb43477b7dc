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

// Whether the path is a folder of a layout above; a file is judged by read_truth_clips().
[[nodiscard]] bool is_truth_folder(const std::filesystem::path& path);

// Results of all clips in one file of layout aot or coco, which calls images as the truth does: those of each clip, in
// order. Errors as read_results(); a layout without names of images.
[[nodiscard]] Result<std::vector<Results>> read_shared_results(const std::filesystem::path& path,
                                                               const std::vector<const TruthClip*>& clips,
                                                               ResultsFormat format);

}  // namespace sigs
