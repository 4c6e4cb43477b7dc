// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/pose.h"
#include "ego_motion/ego_motion.h"
#include "plot/plot.h"

namespace sigs {

namespace {

bool is_known(const EgoFrame& frame, int axis) {
  return frame.sd_rad[axis] < kUnknownRotation_rad / 2;
}

// One angle over time; angles that pass 180 degrees go on beyond it.
Plot angle_plot(const EgoMotion& motion, int axis, const std::string& name) {
  Plot plot{.title = name + ", with a band of two standard deviations since frame 0; nothing is known where grey",
            .x_label = "time [s]",
            .y_label = name + " [deg]",
            .x_range = {0, std::max(motion.frames.back().time_s, 1e-3)}};
  PlotSeries angles{.title = name, .runs = {{}}};
  PlotSeries band{.title = "2 standard deviations"};
  double low_deg = 1e300, high_deg = -1e300, before_deg = 0;
  for (std::size_t k = 0; k < motion.frames.size(); ++k) {
    const EgoFrame& frame = motion.frames[k];
    const Attitude attitude = attitude_of(frame.world_from_camera);
    double angle_deg =
        deg_of_rad(std::array{attitude.roll_rad, attitude.pitch_rad, attitude.yaw_rad}[static_cast<std::size_t>(axis)]);
    if (k > 0) angle_deg -= 360 * std::round((angle_deg - before_deg) / 360);
    before_deg = angle_deg;
    low_deg = std::min(low_deg, angle_deg);
    high_deg = std::max(high_deg, angle_deg);
    angles.runs.front().push_back({frame.time_s, angle_deg});
    const bool begins = k == 0 || is_known(motion.frames[k - 1], axis) != is_known(frame, axis);
    if (is_known(frame, axis)) {
      const double reach_deg = 2 * deg_of_rad(frame.sd_rad[axis]);
      if (begins) band.runs.resize(band.runs.size() + 2);
      band.runs.end()[-2].push_back({frame.time_s, angle_deg + reach_deg});
      band.runs.back().push_back({frame.time_s, angle_deg - reach_deg});
    } else {
      if (begins) plot.shaded.push_back({frame.time_s, frame.time_s});
      plot.shaded.back().last = k + 1 < motion.frames.size() ? motion.frames[k + 1].time_s : frame.time_s;
    }
  }
  const double margin_deg = std::max(0.05, 0.08 * (high_deg - low_deg));
  plot.y_range = {low_deg - margin_deg, high_deg + margin_deg};
  plot.series = {std::move(angles), std::move(band)};
  return plot;
}

}  // namespace

cv::Mat attitude_plot(const EgoMotion& motion) {
  std::vector<cv::Mat> plots;
  for (const auto& [axis, name] : {std::pair(0, "Roll"), {1, "Pitch"}, {2, "Yaw"}})
    plots.push_back(image_of(angle_plot(motion, axis, name)));
  cv::Mat page;
  cv::vconcat(plots, page);
  return page;
}

}  // namespace sigs
