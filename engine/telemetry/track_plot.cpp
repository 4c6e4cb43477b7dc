// SPDX-License-Identifier: MIT
#include "telemetry/track_plot.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/pose.h"
#include "geo/geodetic.h"
#include "telemetry/plot_axes.h"

namespace sigs {
namespace {

constexpr int kWidth_px = 1200;
constexpr int kPanel_px = 260;
constexpr int kMap_px = 620;
constexpr int kLeft_px = 90;
constexpr int kRight_px = 150;  // for the legend
constexpr int kTop_px = 34;
constexpr int kBottom_px = 44;
const cv::Scalar kInk(40, 40, 40);
const cv::Scalar kColors[] = {{200, 90, 20},  {30, 100, 220}, {40, 150, 40},
                              {160, 60, 160}, {60, 160, 190}, {110, 110, 110}};

struct Series {
  std::string label;
  std::vector<double> x;
  std::vector<double> y;
};

struct Panel {
  std::string title;  // with the unit
  std::string x_title = "time, s";
  std::vector<Series> series = {};
  bool same_scale = false;  // of both axes
};

struct Axis {
  double low = 0;
  double high = 1;
  int first_px = 0;  // where `low` is drawn
  int last_px = 1;

  [[nodiscard]] int at(double value) const {
    const double share = (value - low) / (high - low);  // of numbers beyond 1e308 it may be none
    return first_px + (std::isfinite(share) ? static_cast<int>(std::lround(share * (last_px - first_px))) : 0);
  }
};

Axis axis_of(const std::vector<Series>& series, const std::vector<double> Series::*numbers, int first_px, int last_px) {
  Axis axis{INFINITY, -INFINITY, first_px, last_px};
  for (const Series& one : series) {
    for (const double number : one.*numbers) {
      axis.low = std::min(axis.low, number);
      axis.high = std::max(axis.high, number);
    }
  }
  const double margin = std::max({0.05 * (axis.high - axis.low), 1e-6 * std::abs(axis.high), 1e-3});
  axis.low -= margin;
  axis.high += margin;
  return axis;
}

void widen(Axis& axis, double per_px) {
  const double range = per_px * std::abs(axis.last_px - axis.first_px);
  const double middle = (axis.low + axis.high) / 2;
  axis.low = middle - range / 2;
  axis.high = middle + range / 2;
}

void make_same_scale(Axis& x, Axis& y) {
  const double per_px = std::max((x.high - x.low) / std::abs(x.last_px - x.first_px),
                                 (y.high - y.low) / std::abs(y.last_px - y.first_px));
  widen(x, per_px);
  widen(y, per_px);
}

std::vector<PlacedTick> ticks_on(const Axis& axis) {
  std::vector<PlacedTick> placed;
  for (Tick& tick : ticks_between(axis.low, axis.high, tick_step(axis.high - axis.low))) {
    const int at_px = axis.at(tick.value);
    placed.push_back({std::move(tick), at_px});
  }
  return placed;
}

// Points in the same column of pixels are drawn from the least to the greatest.
void draw_series(cv::Mat& image, const Series& series, const Axis& x, const Axis& y, const cv::Scalar& color) {
  std::vector<cv::Point> points;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const cv::Point point(x.at(series.x[i]), y.at(series.y[i]));
    if (points.empty() || points.back() != point) points.push_back(point);
  }
  if (points.size() == 1) cv::circle(image, points[0], 3, color, cv::FILLED, cv::LINE_AA);
  cv::polylines(image, points, false, color, 1, cv::LINE_AA);
}

cv::Mat drawn(const Panel& panel, int height_px) {
  cv::Mat image(height_px, kWidth_px, CV_8UC3, cv::Scalar::all(255));
  Axis x = axis_of(panel.series, &Series::x, kLeft_px, kWidth_px - kRight_px);
  Axis y = axis_of(panel.series, &Series::y, height_px - kBottom_px, kTop_px);
  if (panel.same_scale) make_same_scale(x, y);
  draw_axes(image, {x.first_px, y.last_px}, {x.last_px, y.first_px}, ticks_on(x), ticks_on(y), {.ink = kInk});
  draw_text(image, panel.title, {kLeft_px, kTop_px - 10}, kInk);
  draw_text_until(image, panel.x_title, {kWidth_px - kRight_px, height_px - 8}, kInk);
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    const cv::Scalar& color = kColors[i % std::size(kColors)];
    draw_series(image, panel.series[i], x, y, color);
    const int row = kTop_px + 14 + 20 * static_cast<int>(i);
    cv::line(image, {kWidth_px - kRight_px + 10, row - 4}, {kWidth_px - kRight_px + 30, row - 4}, color, 2,
             cv::LINE_AA);
    draw_text(image, panel.series[i].label, {kWidth_px - kRight_px + 36, row}, kInk);
  }
  return image;
}

// Angles go on beyond 180 degrees rather than jump.
void add_attitude(Panel& panel, const std::string& prefix, const Channel<glm::dquat>& channel) {
  if (channel.empty()) return;
  Series roll{prefix + "roll", channel.times_s, {}};
  Series pitch{prefix + "pitch", channel.times_s, {}};
  Series yaw{prefix + "yaw", channel.times_s, {}};
  const auto add = [](Series& series, double deg) {
    if (!series.y.empty()) deg += 360 * std::round((series.y.back() - deg) / 360);
    series.y.push_back(deg);
  };
  for (const glm::dquat& value : channel.values) {
    const Attitude attitude = attitude_of(value);
    add(roll, deg_of_rad(attitude.roll_rad));
    add(pitch, deg_of_rad(attitude.pitch_rad));
    add(yaw, deg_of_rad(attitude.yaw_rad));
  }
  for (Series* series : {&roll, &pitch, &yaw}) panel.series.push_back(std::move(*series));
}

Panel rates_panel(const std::string& title, const Channel<glm::dvec3>& channel) {
  Panel panel{.title = title};
  if (channel.empty()) return panel;
  for (int axis = 0; axis < 3; ++axis) {
    Series series{axis == 0 ? "X forward" : axis == 1 ? "Y right" : "Z down", channel.times_s, {}};
    for (const glm::dvec3& value : channel.values) series.y.push_back(deg_of_rad(value[axis]));
    panel.series.push_back(std::move(series));
  }
  return panel;
}

Panel height_panel(const Track& track) {
  Panel panel{.title = "height, m"};
  Series height{track.position.empty() ? "local" : "height", {}, {}};
  if (!track.position.empty()) {
    height.x = track.position.times_s;
    for (const GeodeticPosition& place : track.position.values) height.y.push_back(place.height_m);
  } else {
    height.x = track.local_position_ned_m.times_s;
    for (const glm::dvec3& place : track.local_position_ned_m.values) height.y.push_back(-place.z);
  }
  if (!height.x.empty()) panel.series.push_back(std::move(height));
  return panel;
}

Panel map_panel(const Track& track) {
  Panel panel{.title = "ground track, m north", .x_title = "m east", .same_scale = true};
  Series path{"path", {}, {}};
  const auto add = [&](const glm::dvec3& ned) {
    path.x.push_back(ned.y);
    path.y.push_back(ned.x);
  };
  if (!track.position.empty()) {
    const LocalFrame frame(track.position.values.front(), 0);  // heading 0: the world's X is north
    for (const GeodeticPosition& place : track.position.values) add(frame.world_of(place));
  } else {
    for (const glm::dvec3& place : track.local_position_ned_m.values) add(place);
  }
  if (path.x.empty()) return panel;
  Series start{"start", {path.x.front()}, {path.y.front()}};
  panel.series = {std::move(path), std::move(start)};
  return panel;
}

}  // namespace

cv::Mat track_plot(const Track& track) {
  Panel attitude{.title = "attitude, degrees"};
  add_attitude(attitude, "", track.ned_from_airframe);
  add_attitude(attitude, "camera ", track.ned_from_camera);
  if (attitude.series.empty()) {
    attitude.title = "attitude of the camera against its start, degrees";
    add_attitude(attitude, "camera ", track.start_from_camera);
  }
  std::vector<cv::Mat> images;
  for (const Panel& panel :
       {attitude, rates_panel("angular rate of the camera, degrees/s", track.camera_rate_radps),
        rates_panel("angular rate of the airframe, degrees/s", track.airframe_rate_radps), height_panel(track)})
    if (!panel.series.empty()) images.push_back(drawn(panel, kPanel_px));
  if (const Panel map = map_panel(track); !map.series.empty()) images.push_back(drawn(map, kMap_px));
  cv::Mat all;
  if (!images.empty()) cv::vconcat(images, all);
  return all;
}

}  // namespace sigs
