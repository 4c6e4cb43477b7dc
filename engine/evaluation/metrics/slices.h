// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "evaluation/metrics/detection_score.h"

namespace sigs {

// How well a detector sees intruders by what they look like, and how sure a figure is.

// An interval that holds 95 % of what the figure is when encounters, or flights, are drawn anew, as many as there are
// (bootstrap of whole groups: Efron and Tibshirani 1993, section 13; percentiles of 2000 draws of a fixed sequence).
// NaN where there are less than two groups to draw from. Groups that all have 0, or all 1, do not tell by draws how
// far that may be by chance: then it is Wilson's interval (1927) of as many trials as there are groups.
struct Interval {
  double low = 0;
  double high = 0;
};

// Part of a whole, of one group. Groups are independent of each other; what is within a group is not.
struct GroupShare {
  double part = 0;
  double whole = 0;
};

// Of sum(part) / sum(whole). Draws without any whole are left out.
[[nodiscard]] Interval share_interval(const std::vector<GroupShare>& groups);

// Of the difference of two such shares, first less second, over the same groups: each draw takes the same groups of
// both. As many of one as of the other.
[[nodiscard]] Interval difference_interval(const std::vector<GroupShare>& first, const std::vector<GroupShare>& second);

// Frames in which some of an intruder is visible, at any range, that have something in common.
struct FrameSlice {
  std::string by;    // "all", "range", "size", "contrast", "horizon", "visible"
  std::string name;  // "100 to 300 m"
  int frames = 0;    // (frame, intruder) pairs
  int matched = 0;
  Interval rate;  // of share(), by drawing flights: one intruder of one clip

  // matched / frames; NaN where there is no frame.
  [[nodiscard]] double share() const { return double(matched) / frames; }
};

// What makes a frame, in which some of the intruder is visible, part of a slice.
struct SliceRule {
  std::string by;
  std::string name;
  std::function<bool(const TargetFrame&)> has;
};
[[nodiscard]] std::vector<SliceRule> slice_rules();

// All slices, those without frames too, in the same order for each detector. Contrast is the RMS contrast of the
// labels; frames whose labels do not have it are in none of its slices.
[[nodiscard]] std::vector<FrameSlice> frame_slices(const std::vector<DetectedClip>& clips,
                                                   const DetectionPolicy& policy);

}  // namespace sigs
