// SPDX-License-Identifier: MIT
#include "occlusion/slow_drift.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "base/ensure.h"

namespace sigs {

namespace {

constexpr int kScale = 2;                 // of the images worked on: shifts are of things, not of pixels
constexpr int kWindow = 9;                // pixels of these that share a shift
constexpr int kSpill = 3;                 // pixels of the mean images beside what moves that do not count either
constexpr double kMinBend = 0.1;          // gray levels per pixel and pixel, squared: below, noise bends as much
constexpr double kMinSlope = 0.05;        // gray levels per pixel, squared
constexpr double kMinChange = 0.01;       // likewise, per segment
constexpr double kMinShiftSquare = 1e-4;  // pixels
constexpr double kStays = 0.1;            // pixels of the mean images
constexpr double kCreeps = 0.3;
constexpr double kByChance = 0.3;     // correlation of successive shifts: of two dozen vibrating ones below,
constexpr double kSteady = 0.6;       // of ones that creep one way above
constexpr double kUnexplained = 0.3;  // share of the change that a shift explains: the border of a body before a
constexpr double kExplained = 0.6;    // moving world stays below, clouds are above

struct Slope {
  cv::Mat x, y;
};

Slope slope_of(const cv::Mat& image) {
  const cv::Mat half = (cv::Mat_<float>(1, 3) << -0.5F, 0, 0.5F);
  Slope slope;
  cv::filter2D(image, slope.x, CV_32F, half, {-1, -1}, 0, cv::BORDER_REPLICATE);
  cv::filter2D(image, slope.y, CV_32F, half.t(), {-1, -1}, 0, cv::BORDER_REPLICATE);
  return slope;
}

cv::Mat halved(const cv::Mat& image) {
  cv::Mat small;
  cv::resize(image, small, {std::max(1, image.cols / kScale), std::max(1, image.rows / kScale)}, 0, 0, cv::INTER_AREA);
  return small;
}

cv::Mat small_picture(const MeanFrame& segment) {
  cv::Mat small = halved(segment.luma);
  cv::GaussianBlur(small, small, {5, 5}, 0);
  return small;
}

cv::Mat clamped(const cv::Mat& values, double zero_at, double one_at) {
  return cv::min(cv::max((values - zero_at) / (one_at - zero_at), 0.0), 1.0);
}

// The normal equations of a window's shift: what belongs to the mean image is worked out once.
class ShiftFinder {
 public:
  ShiftFinder(const cv::Mat& mean, cv::Mat weight) : weight_(std::move(weight)), slope_(slope_of(mean)) {
    const Slope along_x = slope_of(slope_.x);
    bend_xx_ = along_x.x;
    bend_xy_ = along_x.y;
    bend_yy_ = slope_of(slope_.y).y;
    xx_ = windowed(bend_xx_.mul(bend_xx_) + bend_xy_.mul(bend_xy_)) + kMinBend;
    yy_ = windowed(bend_yy_.mul(bend_yy_) + bend_xy_.mul(bend_xy_)) + kMinBend;
    xy_ = windowed(bend_xy_.mul(bend_xx_ + bend_yy_));
    determinant_ = xx_.mul(yy_) - xy_.mul(xy_);
    slope_square_ = windowed(slope_.x.mul(slope_.x) + slope_.y.mul(slope_.y)) + kMinSlope;
  }

  struct Shift {
    cv::Mat x, y;       // pixels of the small images
    cv::Mat explained;  // of the change, in squared gray levels per pixel
    cv::Mat change;     // that change of contrast does not explain
  };

  [[nodiscard]] Shift shift_of(const cv::Mat& difference) const {
    Slope change = slope_of(difference);
    const cv::Mat contrast = windowed(change.x.mul(slope_.x) + change.y.mul(slope_.y)) / slope_square_;
    change.x -= contrast.mul(slope_.x);
    change.y -= contrast.mul(slope_.y);
    const cv::Mat to_x = windowed(bend_xx_.mul(change.x) + bend_xy_.mul(change.y));
    const cv::Mat to_y = windowed(bend_xy_.mul(change.x) + bend_yy_.mul(change.y));
    Shift shift{.x = cv::Mat(yy_.mul(to_x) - xy_.mul(to_y)) / determinant_,
                .y = cv::Mat(xx_.mul(to_y) - xy_.mul(to_x)) / determinant_};
    shift.explained = shift.x.mul(to_x) + shift.y.mul(to_y);
    shift.change = windowed(change.x.mul(change.x) + change.y.mul(change.y));
    return shift;
  }

 private:
  [[nodiscard]] cv::Mat windowed(const cv::Mat& values) const {
    cv::Mat sums;
    cv::boxFilter(values.mul(weight_), sums, CV_32F, {kWindow, kWindow}, {-1, -1}, true, cv::BORDER_REFLECT);
    return sums;
  }

  cv::Mat weight_;
  Slope slope_;
  cv::Mat bend_xx_, bend_xy_, bend_yy_;
  cv::Mat xx_, xy_, yy_, determinant_;
  cv::Mat slope_square_;
};

// Pixels close to what moves do not count either: there, what moves shows through a blurred border.
cv::Mat weight_of(const cv::Mat& ratio) {
  cv::Mat near;
  cv::dilate(ratio, near, cv::Mat::ones(kSpill, kSpill, CV_8UC1));
  return halved(1.0 / cv::Mat(near.mul(near) + 1.0));
}

cv::Mat mean_of(const std::vector<cv::Mat>& images) {
  cv::Mat sum = cv::Mat::zeros(images.front().size(), CV_32FC1);
  for (const cv::Mat& image : images) sum += image;
  return sum / static_cast<double>(images.size());
}

}  // namespace

cv::Mat drifting(const std::vector<MeanFrame>& segments, const cv::Mat& ratio) {
  ENSURE(!segments.empty());
  std::vector<cv::Mat> images;
  for (const MeanFrame& segment : segments) images.push_back(small_picture(segment));
  const cv::Mat mean = mean_of(images);
  const ShiftFinder finder(mean, weight_of(ratio));
  const cv::Size size = mean.size();
  cv::Mat agreeing = cv::Mat::zeros(size, CV_32FC1);
  cv::Mat square(size, CV_32FC1, cv::Scalar(kMinShiftSquare * static_cast<double>(segments.size())));
  cv::Mat explained = cv::Mat::zeros(size, CV_32FC1);
  cv::Mat change(size, CV_32FC1, cv::Scalar(kMinChange * static_cast<double>(segments.size())));
  ShiftFinder::Shift before;
  for (const cv::Mat& image : images) {
    ShiftFinder::Shift shift = finder.shift_of(image - mean);
    if (!before.x.empty()) agreeing += before.x.mul(shift.x) + before.y.mul(shift.y);
    square += shift.x.mul(shift.x) + shift.y.mul(shift.y);
    explained += shift.explained;
    change += shift.change;
    before = std::move(shift);
  }
  const double pairs = std::max(1.0, static_cast<double>(segments.size()) - 1);
  cv::Mat shift;
  cv::sqrt(cv::max(agreeing / pairs, 0.0), shift);
  shift *= kScale;
  const cv::Mat steady = clamped(agreeing / square, kByChance, kSteady);
  const cv::Mat is_shift = clamped(explained / change, kUnexplained, kExplained);
  const cv::Mat creeps = clamped(shift, kStays, kCreeps).mul(steady).mul(is_shift);
  cv::Mat full;
  cv::resize(creeps, full, ratio.size(), 0, 0, cv::INTER_LINEAR);
  // Only where all windows around agree: a window at a body's border sees the world too.
  cv::erode(full, full, cv::Mat::ones(kWindow, kWindow, CV_8UC1));
  return full;
}

}  // namespace sigs
