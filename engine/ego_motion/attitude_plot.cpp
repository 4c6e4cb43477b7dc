// SPDX-License-Identifier: MIT
#include "ego_motion/ego_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/pose.h"
#include "plot/plot.h"

namespace sigs {

namespace {

constexpr double kPanelHeight = 270;
constexpr PlotColor kLine{20, 80, 170}, kBand{170, 210, 240}, kLost{200, 200, 200};

// One angle with its standard deviation. Angles that pass 180 degrees go on beyond it.
Plot angle_plot(const EgoMotion& motion, const std::string& name, int axis, double Attitude::*angle_rad) {
  PlotSeries lost{.title = "nothing is known", .kind = SeriesKind::areas, .color = kLost};
  PlotSeries band{.title = "2 standard deviations since frame 0", .kind = SeriesKind::areas, .color = kBand};
  PlotSeries line{.title = name, .runs = {{}}, .color = kLine};
  std::vector<PlotPoint>& points = line.runs.front();
  for (const EgoFrame& frame : motion.frames) {
    const double deg = deg_of_rad(attitude_of(frame.world_from_camera).*angle_rad);
    const double turns = points.empty() ? 0 : std::round((points.back().y - deg) / 360);
    points.push_back({frame.time_s, deg + 360 * turns});
  }
  const PlotSpan range = range_of({line}, &PlotPoint::y, 0.08);
  for (std::size_t k = 0; k < points.size(); ++k) {  // each to the next frame
    const double next_s = points[std::min(k + 1, points.size() - 1)].x;
    const double sd_deg = deg_of_rad(motion.frames[k].sd_rad[axis]);
    if (sd_deg < deg_of_rad(kUnknownRotation_rad) / 2)
      band.runs.push_back({{points[k].x, points[k].y + 2 * sd_deg}, {next_s, points[k].y - 2 * sd_deg}});
    else
      lost.runs.push_back({{points[k].x, range.first}, {next_s, range.last}});
  }
  return {.title = name + ", degrees",
          .x_label = "time, s",
          .x_range = {0, std::max(points.back().x, 1e-3)},
          .y_range = range,
          .series = {std::move(lost), std::move(band), std::move(line)},
          .height = kPanelHeight};
}

}  // namespace

cv::Mat attitude_plot(const EgoMotion& motion) {
  return image_of({angle_plot(motion, "roll", 0, &Attitude::roll_rad),
                   angle_plot(motion, "pitch", 1, &Attitude::pitch_rad),
                   angle_plot(motion, "yaw", 2, &Attitude::yaw_rad)});
}

}  // namespace sigs
