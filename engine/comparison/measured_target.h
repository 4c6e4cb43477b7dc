// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <vector>

#include "appearance/target_look.h"
#include "base/image.h"
#include "base/result.h"
#include "video/frame_source.h"

namespace sigs {

// Successive frames of a clip with a box of the target in each; the look is measured in the middle one, the flicker
// over all of them.
struct Stretch {
  int middle = 0;  // number in the clip of the middle frame
  std::vector<Frame> frames;
  std::vector<Box> boxes;

  // Frames before the middle one.
  [[nodiscard]] int reach() const { return static_cast<int>(frames.size()) / 2; }
  [[nodiscard]] const Frame& middle_frame() const { return frames[frames.size() / 2]; }
  [[nodiscard]] const Box& middle_box() const { return boxes[boxes.size() / 2]; }
};

inline constexpr int kStretchReach = 3;  // frames before and after the middle one

// The stretch around a frame. Where the clip or the boxes end within it, the middle frame alone; none where that has no
// box. Errors are those of FrameSource::read.
//   reach  frames before and after the middle one
[[nodiscard]] Result<std::optional<Stretch>> stretch_around(FrameSource& footage,
                                                            const std::vector<std::optional<Box>>& boxes, int middle,
                                                            int reach = kStretchReach);

// A target as it was measured.
struct MeasuredTarget {
  TargetLook look;  // in the middle frame
  cv::Mat image;    // CV_8UC3, BGR: its surroundings there
  // Its centroid in the successive frames against the middle one; empty where it was not found in each.
  std::vector<cv::Point2d> path_px;
};

// Measures a target in successive frames, the middle one being the one that counts. None where it cannot be told from
// the background there.
//   boxes  loose, one for each frame
[[nodiscard]] std::optional<MeasuredTarget> measured_target(std::span<const Frame> frames, std::span<const Box> boxes);

// Reads where a target is in each frame of a clip: CSV with a header line and the columns frame,label,x,y,w,h in this
// order; frames count from 0, x and y are MATLAB's pixels, whose first one has its centre at (1, 1), as in the
// published boxes of the Svanstrom data set (doi:10.5281/zenodo.5500576). Returns boxes by frame, none where a frame
// has no line or a box without area. Where a frame has several lines the first one counts. Errors: cannot_read;
// bad_data (file and line) for what is no number, a frame beyond 10 million, no box at all.
[[nodiscard]] Result<std::vector<std::optional<Box>>> read_target_boxes(const std::filesystem::path& csv);

}  // namespace sigs
