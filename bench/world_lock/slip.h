// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "world_lock/fixed_intruders.h"

namespace sigs::bench {

// One intruder in one frame, under every knowledge of the camera.
struct SlipSample {
  int start = 0;  // frame in which the intruder was put in
  int place = 0;
  int frame = 0;
  double since_s = 0;                  // since it was put in
  int corners = 0;                     // that the background's step is the median of
  double reference_sd_px = 0;          // of that median
  double growth = 1;                   // of the background since the start; above 1: it comes nearer
  cv::Point2d start_px;                // where it was put in
  cv::Point2d background;              // where the point of the background is
  std::vector<cv::Point2d> step_px;    // by knowledge: the intruder's step less the background's
  std::vector<cv::Point2d> offset_px;  // by knowledge: how far the intruder is from where it was put in the world
};

struct SlipRun {
  std::vector<SlipSample> samples;
  double distances_differ_px = 0;  // largest difference between the pixels of the first distance and of the others
};

// Puts intruders at each distance in front of up to 3 points of the background and follows both until the point
// is lost, leaves the image or 10 s have passed; then the same again from there, to the end of the clip.
[[nodiscard]] SlipRun slip_of(const Clip& clip, const std::vector<CameraKnowledge>& cameras,
                              std::span<const double> distances_m = kDistances_m);

inline constexpr double kLongest_s = 10;

// What is left of offset_px without the parallax of a camera that travels straight on: then the image around a point
// grows by the same factor as the point's distance from the direction of flight, wherever that is,
//   offset = -(growth - 1) * (start_px - flight_px)
// The growth is measured; flight_px is fitted, two numbers for all the points of a start, with the offsets of the last
// knowledge of the camera. The same knowledge's rotation may be wrong: that does not grow with the image, and is left.
// By sample, then by knowledge. Where no point grew by 0.5 %, nothing is taken off.
[[nodiscard]] std::vector<std::vector<cv::Point2d>> offsets_beyond_parallax(const SlipRun& run);

// Slip from frame to frame less its mean over a second of the same point: parallax and drift change slowly, trembling
// does not. By sample, then by knowledge.
[[nodiscard]] std::vector<std::vector<cv::Point2d>> trembling(const SlipRun& run);

// Strips of enlarged frames, 60 frames apart, each around the same point of the background: above with the camera's
// attitude constant, below with the estimated one. One PNG for each distance, in the folder `images`. The strips show
// the footage, which need not be ours to publish.
void draw_strips(const std::string& clip, const std::filesystem::path& folder, const std::filesystem::path& images);

// The same of our own footage, for docs/images.
void draw_figure(const std::filesystem::path& folder, const std::filesystem::path& figure);

}  // namespace sigs::bench
