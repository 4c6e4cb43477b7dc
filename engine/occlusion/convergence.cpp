// SPDX-License-Identifier: MIT
#include "occlusion/convergence.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "occlusion/mask_geometry.h"

namespace sigs {

namespace {

constexpr double kGrowth = 1.5;
constexpr int kQuietChecks = 3;
constexpr double kQuiet_s = 10;         // a turn that brings other ground into view takes some seconds
constexpr double kSurelyWorld = 0.25;   // confidence below it
constexpr double kMinKnown = 0.5;       // share of what is not masked that is surely world
constexpr double kUndecidedFrom = 0.3;  // confidence
constexpr double kUndecidedTo = 0.7;
constexpr double kSquare = 0.02;  // side by the image's diagonal: wider than the undecided band along a border

bool is_world_known(const Verdict& verdict) {
  const cv::Mat world = verdict.own_body == 0;
  const cv::Mat surely = verdict.confidence < kSurelyWorld;
  return cv::countNonZero(world & surely) >= kMinKnown * cv::countNonZero(world);
}

// A part that one check takes for body and the next for world is undecided before it changes sides.
bool has_undecided_square(const Verdict& verdict) {
  cv::Mat undecided;
  cv::inRange(verdict.confidence, kUndecidedFrom, kUndecidedTo, undecided);
  const int side_px = std::max(3, static_cast<int>(std::lround(kSquare * std::hypot(undecided.cols, undecided.rows))));
  cv::erode(undecided, undecided, cv::Mat::ones(side_px, side_px, CV_8U));
  return cv::countNonZero(undecided) > 0;
}

}  // namespace

void ConvergenceCheck::check(const Verdict& verdict, int frames_used, double passed_s) {
  next_check_ = static_cast<int>(frames_used * kGrowth);
  last_change_ = mask_.empty() || verdict.undecided ? 1 : 1 - intersection_over_union(mask_, verdict.own_body);
  const bool is_quiet = last_change_ < min_change_ && is_world_known(verdict) && !has_undecided_square(verdict);
  if (is_quiet && quiet_checks_ == 0) quiet_since_s_ = checked_s_;
  quiet_checks_ = is_quiet ? quiet_checks_ + 1 : 0;
  converged_ = quiet_checks_ >= kQuietChecks && passed_s - quiet_since_s_ >= kQuiet_s;
  mask_ = verdict.undecided ? cv::Mat() : verdict.own_body;
  checked_s_ = passed_s;
}

}  // namespace sigs
