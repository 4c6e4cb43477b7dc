// SPDX-License-Identifier: MIT
#include "cli/encounter_model_plot.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>

#include "telemetry/plot_axes.h"

namespace sigs::cli {

namespace {

constexpr int kWidth_px = 1200;
constexpr int kMap_px = 760;
constexpr int kPanel_px = 260;
constexpr int kLeft_px = 90;
constexpr int kRight_px = 30;
constexpr int kTop_px = 34;
constexpr int kBottom_px = 44;
const cv::Scalar kInk(40, 40, 40);

// What a panel shows of each point.
struct Quantity {
  std::string title;
  std::string x_title;
  double (*x)(const SampledPoint&);
  double (*y)(const SampledPoint&);
  bool same_scale = false;
};

struct Axis {
  double low = INFINITY;
  double high = -INFINITY;
  int first_px = 0;  // where `low` is drawn
  int last_px = 1;

  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  void widen_to(double range) {
    const double middle = (low + high) / 2;
    low = middle - range / 2;
    high = middle + range / 2;
  }
  [[nodiscard]] int length_px() const { return std::abs(last_px - first_px); }
  [[nodiscard]] int at_px(double value) const {
    return first_px + static_cast<int>(std::lround((value - low) / (high - low) * (last_px - first_px)));
  }
};

std::vector<PlacedTick> ticks_on(const Axis& axis) {
  std::vector<PlacedTick> placed;
  for (Tick& tick : ticks_between(axis.low, axis.high, tick_step(axis.high - axis.low))) {
    const int at_px = axis.at_px(tick.value);
    placed.push_back({std::move(tick), at_px});
  }
  return placed;
}

// Colours all around the circle of hues, dark enough on white.
cv::Scalar color_of(std::size_t number, std::size_t count) {
  cv::Mat pixel(1, 1, CV_8UC3, cv::Scalar(static_cast<double>(180 * number / count), 200, 190));
  cv::cvtColor(pixel, pixel, cv::COLOR_HSV2BGR);
  return cv::Scalar(pixel.at<cv::Vec3b>(0, 0));
}

std::pair<Axis, Axis> axes_of(const std::vector<ModelFlight>& tracks, const Quantity& quantity, int height_px) {
  Axis x{.first_px = kLeft_px, .last_px = kWidth_px - kRight_px};
  Axis y{.first_px = height_px - kBottom_px, .last_px = kTop_px};
  for (const ModelFlight& track : tracks)
    for (const SampledPoint& point : track.points) {
      x.include(quantity.x(point));
      y.include(quantity.y(point));
    }
  for (Axis* const axis : {&x, &y}) axis->widen_to(std::max(1.08 * (axis->high - axis->low), 1.0));
  if (quantity.same_scale) {
    const double per_px = std::max((x.high - x.low) / x.length_px(), (y.high - y.low) / y.length_px());
    for (Axis* const axis : {&x, &y}) axis->widen_to(per_px * axis->length_px());
  }
  return {x, y};
}

cv::Mat panel(const std::vector<ModelFlight>& tracks, const Quantity& quantity, int height_px) {
  cv::Mat image(height_px, kWidth_px, CV_8UC3, cv::Scalar::all(255));
  const auto [x, y] = axes_of(tracks, quantity, height_px);
  draw_axes(image, {x.first_px, y.last_px}, {x.last_px, y.first_px}, ticks_on(x), ticks_on(y), {.ink = kInk});
  draw_text(image, quantity.title, {kLeft_px, kTop_px - 10}, kInk);
  draw_text_until(image, quantity.x_title, {kWidth_px - kRight_px, height_px - 8}, kInk);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    std::vector<cv::Point> line;
    for (const SampledPoint& point : tracks[i].points)
      line.emplace_back(x.at_px(quantity.x(point)), y.at_px(quantity.y(point)));
    cv::polylines(image, line, false, color_of(i, tracks.size()), 1, cv::LINE_AA);
    if (quantity.same_scale) cv::circle(image, line.back(), 3, color_of(i, tracks.size()), cv::FILLED, cv::LINE_AA);
  }
  return image;
}

}  // namespace

cv::Mat flights_plot(const std::vector<ModelFlight>& tracks) {
  const auto time = [](const SampledPoint& point) { return point.time_s; };
  const Quantity map{.title = "from above, m north; dots: the flights' ends",
                     .x_title = "m east",
                     .x = [](const SampledPoint& point) { return point.position_neu_m.y; },
                     .y = [](const SampledPoint& point) { return point.position_neu_m.x; },
                     .same_scale = true};
  std::vector<cv::Mat> images{panel(tracks, map, kMap_px)};
  for (const Quantity& quantity :
       {Quantity{"altitude, m", "time, s", time, [](const SampledPoint& point) { return point.position_neu_m.z; }},
        Quantity{"speed over the ground, m/s", "time, s", time,
                 [](const SampledPoint& point) { return point.speed_mps; }},
        Quantity{"vertical speed, m/s", "time, s", time,
                 [](const SampledPoint& point) { return point.vertical_speed_mps; }}})
    images.push_back(panel(tracks, quantity, kPanel_px));
  cv::Mat all;
  cv::vconcat(images, all);
  return all;
}

}  // namespace sigs::cli
