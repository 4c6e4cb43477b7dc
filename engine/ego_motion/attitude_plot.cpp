// SPDX-License-Identifier: MIT
#include "ego_motion/attitude_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "base/pose.h"
#include "telemetry/plot_axes.h"

namespace sigs {

namespace {

constexpr int kWidth_px = 1200;
constexpr int kPanel_px = 280;
constexpr int kLeft_px = 90;
constexpr int kRight_px = 20;
constexpr int kTop_px = 34;
constexpr int kBottom_px = 34;
const cv::Scalar kInk(60, 60, 60);
const cv::Scalar kBand(240, 210, 170);
const cv::Scalar kLine(170, 80, 20);
const cv::Scalar kLost(200, 200, 200);

// A curve with its standard deviation, degrees; lost where nothing is known.
struct Curve {
  const char* name;
  std::vector<double> values_deg;
  std::vector<double> sd_deg;
};

// Angles that pass 180 degrees go on beyond it.
void unwrap(std::vector<double>& angles_deg) {
  for (std::size_t i = 1; i < angles_deg.size(); ++i)
    angles_deg[i] -= 360 * std::round((angles_deg[i] - angles_deg[i - 1]) / 360);
}

class Panel {
 public:
  Panel(cv::Mat image, const EgoMotion& motion, const Curve& curve) : image_(image), motion_(motion), curve_(curve) {
    low_ = *std::min_element(curve.values_deg.begin(), curve.values_deg.end());
    high_ = *std::max_element(curve.values_deg.begin(), curve.values_deg.end());
    const double margin = std::max(0.05, 0.08 * (high_ - low_));
    low_ -= margin;
    high_ += margin;
    end_s_ = std::max(motion.frames.back().time_s, 1e-3);
  }

  void draw() {
    for (std::size_t k = 0; k < curve_.values_deg.size(); ++k) draw_frame(k);
    draw_frame_and_grid();
    std::vector<cv::Point> line;
    for (std::size_t k = 0; k < curve_.values_deg.size(); ++k)
      line.emplace_back(x_of(motion_.frames[k].time_s), y_of(curve_.values_deg[k]));
    cv::polylines(image_, line, false, kLine, 1, cv::LINE_AA);
  }

 private:
  [[nodiscard]] int x_of(double time_s) const {
    return kLeft_px + cvRound((kWidth_px - kLeft_px - kRight_px) * time_s / end_s_);
  }
  [[nodiscard]] int y_of(double value) const {
    const double share = std::clamp((value - low_) / (high_ - low_), 0.0, 1.0);
    return kPanel_px - kBottom_px - cvRound((kPanel_px - kTop_px - kBottom_px) * share);
  }

  // The band from this frame to the next; all of the height where nothing is known.
  void draw_frame(std::size_t k) {
    const double time_s = motion_.frames[k].time_s;
    const double next_s = k + 1 < motion_.frames.size() ? motion_.frames[k + 1].time_s : time_s;
    const bool known = curve_.sd_deg[k] < deg_of_rad(kUnknownRotation_rad) / 2;
    const double reach = 2 * curve_.sd_deg[k];
    const cv::Point upper(x_of(time_s), known ? y_of(curve_.values_deg[k] + reach) : kTop_px);
    const cv::Point lower(x_of(next_s), known ? y_of(curve_.values_deg[k] - reach) : kPanel_px - kBottom_px);
    cv::rectangle(image_, upper, lower, known ? kBand : kLost, cv::FILLED);
  }

  void draw_frame_and_grid() {
    const cv::Point corner(kWidth_px - kRight_px, kPanel_px - kBottom_px);
    std::vector<PlacedTick> x;
    for (const Tick& tick : ticks_between(0, end_s_ + 1e-9, tick_step(end_s_))) x.push_back({tick, x_of(tick.value)});
    std::vector<PlacedTick> y;
    for (const Tick& tick : ticks_between(low_, high_, tick_step(high_ - low_))) y.push_back({tick, y_of(tick.value)});
    draw_axes(image_, {kLeft_px, kTop_px}, corner, x, y,
              {.ink = kInk, .below_px = 20, .is_centred = false, .end_px = 12});
    draw_text(image_, std::string(curve_.name) + " [deg], band: 2 standard deviations since frame 0", {kLeft_px, 20},
              kInk);
    draw_text_until(image_, "time [s]", {kWidth_px - kRight_px, kPanel_px - 6}, kInk);
  }

  cv::Mat image_;
  const EgoMotion& motion_;
  const Curve& curve_;
  double low_ = 0;
  double high_ = 1;
  double end_s_ = 1;
};

}  // namespace

cv::Mat attitude_plot(const EgoMotion& motion) {
  std::array<Curve, 3> curves{Curve{"roll"}, Curve{"pitch"}, Curve{"yaw"}};
  for (const EgoFrame& frame : motion.frames) {
    const Attitude attitude = attitude_of(frame.world_from_camera);
    const std::array<double, 3> angles{attitude.roll_rad, attitude.pitch_rad, attitude.yaw_rad};
    for (std::size_t i = 0; i < 3; ++i) {
      curves[i].values_deg.push_back(deg_of_rad(angles[i]));
      curves[i].sd_deg.push_back(deg_of_rad(frame.sd_rad[static_cast<int>(i)]));
    }
  }
  cv::Mat image(3 * kPanel_px, kWidth_px, CV_8UC3, cv::Scalar::all(255));
  for (std::size_t i = 0; i < 3; ++i) {
    unwrap(curves[i].values_deg);
    Panel(image.rowRange(static_cast<int>(i) * kPanel_px, static_cast<int>(i + 1) * kPanel_px), motion, curves[i])
        .draw();
  }
  return image;
}

}  // namespace sigs
