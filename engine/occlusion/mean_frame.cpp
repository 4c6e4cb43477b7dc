// SPDX-License-Identifier: MIT
#include "occlusion/mean_frame.h"

#include <algorithm>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "base/ensure.h"
#include "occlusion/stable_motion.h"

namespace sigs {
namespace {

constexpr int kMaxWidth = 640;        // pixels; finer means cost time and do not make edges more exact
constexpr int kMaxBox = 4;            // 4 * 4 pixels * 8 frames * 255 still fit 16 bits
constexpr int kMaxFramesPerMean = 8;  // frames
constexpr int kMeansAtFirst = 8;      // number of means of one frame each, before groups become longer

void add_row(const std::uint8_t* luma, std::uint16_t* sums, int count) {
  for (int x = 0; x < count; ++x) sums[x] = static_cast<std::uint16_t>(sums[x] + luma[x]);
}

void add_row_of_pairs(const std::uint8_t* luma, std::uint16_t* sums, int count) {
  for (int x = 0; x < count; ++x) sums[x] = static_cast<std::uint16_t>(sums[x] + luma[2 * x] + luma[2 * x + 1]);
}

void add_row_of_boxes(const std::uint8_t* luma, std::uint16_t* sums, int count, int scale, int box) {
  for (int x = 0; x < count; ++x) {
    int sum = sums[x];
    for (int k = 0; k < box; ++k) sum += luma[x * scale + k];
    sums[x] = static_cast<std::uint16_t>(sum);
  }
}

constexpr std::size_t kMaxSegments = 48;

MeanFrame merged(const MeanFrame& a, const MeanFrame& b) {
  const int frames = a.frames + b.frames;
  return {a.luma * (1.0 * a.frames / frames) + b.luma * (1.0 * b.frames / frames), frames};
}

void append(std::vector<MeanFrame>& segments, const MeanFrame& image, int max_frames) {
  if (segments.empty() || segments.back().frames + image.frames > max_frames)
    segments.push_back(image);
  else
    segments.back() = merged(segments.back(), image);
}

constexpr int kShrink = 2;                // by which the means are shrunk: what drifts is larger than a pixel
constexpr int kShiftWindow = 9;           // pixels of the shrunk images that share a shift
constexpr int kMovingMargin = 3;          // pixels of the means around what moves that are left out too
constexpr double kMinCurvature = 0.1;     // gray levels per pixel and pixel, squared: noise has as much
constexpr double kMinSlope = 0.05;        // gray levels per pixel, squared
constexpr double kMinChange = 0.01;       // likewise, per segment
constexpr double kMinShiftSquare = 1e-4;  // pixels
constexpr double kStays_px = 0.1;         // pixels of the mean images
constexpr double kDrifts_px = 0.3;
constexpr double kChanceAgreement = 0.3;  // correlation of successive shifts: of two dozen vibrating ones below,
constexpr double kSteadyAgreement = 0.6;  // of ones that drift one way above
constexpr double kUnexplained = 0.3;      // share of the change that a shift explains: the border of a body before a
constexpr double kExplained = 0.6;        // moving world stays below, clouds are above

struct Slope {
  cv::Mat x, y;
};

// Half of the differences between the neighbours; at a border the pixel itself is one of them.
Slope slope_of(const cv::Mat& image) {
  Slope slope{cv::Mat(image.size(), CV_32FC1), cv::Mat(image.size(), CV_32FC1)};
  const int right = image.cols - 1;
  for (int y = 0; y < image.rows; ++y) {
    const auto* const above = image.ptr<float>(std::max(0, y - 1));
    const auto* const row = image.ptr<float>(y);
    const auto* const below = image.ptr<float>(std::min(image.rows - 1, y + 1));
    auto* const along_x = slope.x.ptr<float>(y);
    auto* const along_y = slope.y.ptr<float>(y);
    along_x[0] = (row[std::min(1, right)] - row[0]) * 0.5F;
    for (int x = 1; x < right; ++x) along_x[x] = (row[x + 1] - row[x - 1]) * 0.5F;
    along_x[right] = (row[right] - row[std::max(0, right - 1)]) * 0.5F;
    for (int x = 0; x <= right; ++x) along_y[x] = (below[x] - above[x]) * 0.5F;
  }
  return slope;
}

// value_of(pixels...) for the pixels at each place of images of one size, CV_32FC1.
template <class Value, class... Images>
cv::Mat by_pixel(const Value& value_of, const cv::Mat& first, const Images&... more) {
  cv::Mat values(first.size(), CV_32FC1);
  for (int y = 0; y < values.rows; ++y) {
    auto* const out = values.ptr<float>(y);
    const auto fill = [&](const auto*... rows) {
      for (int x = 0; x < values.cols; ++x) out[x] = value_of(rows[x]...);
    };
    fill(first.ptr<float>(y), more.template ptr<float>(y)...);
  }
  return values;
}

cv::Mat shrunk(const cv::Mat& image) {
  cv::Mat small;
  cv::resize(image, small, {std::max(1, image.cols / kShrink), std::max(1, image.rows / kShrink)}, 0, 0,
             cv::INTER_AREA);
  return small;
}

cv::Mat small_image(const MeanFrame& segment) {
  cv::Mat small = shrunk(segment.luma);
  cv::GaussianBlur(small, small, {5, 5}, 0);
  return small;
}

// The normal equations of a window's shift. What depends on the mean image alone is computed once.
class ShiftFinder {
 public:
  ShiftFinder(const cv::Mat& mean, cv::Mat weight) : weight_(std::move(weight)), slope_(slope_of(mean)) {
    const Slope along_x = slope_of(slope_.x);
    second_xx_ = along_x.x;
    second_xy_ = along_x.y;
    second_yy_ = slope_of(slope_.y).y;
    xx_ = windowed(second_xx_.mul(second_xx_) + second_xy_.mul(second_xy_)) + kMinCurvature;
    yy_ = windowed(second_yy_.mul(second_yy_) + second_xy_.mul(second_xy_)) + kMinCurvature;
    xy_ = windowed(second_xy_.mul(second_xx_ + second_yy_));
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
    const cv::Mat contrast = windowed_products(change.x, slope_.x, change.y, slope_.y) / slope_square_;
    const auto less = [](float value, float share, float of) { return value - share * of; };
    change.x = by_pixel(less, change.x, contrast, slope_.x);
    change.y = by_pixel(less, change.y, contrast, slope_.y);
    const cv::Mat to_x = windowed_products(second_xx_, change.x, second_xy_, change.y);
    const cv::Mat to_y = windowed_products(second_xy_, change.x, second_yy_, change.y);
    const auto solved = [](float a, float to_a, float b, float to_b, float determinant) {
      return (a * to_a - b * to_b) / determinant;
    };
    Shift shift{.x = by_pixel(solved, yy_, to_x, xy_, to_y, determinant_),
                .y = by_pixel(solved, xx_, to_y, xy_, to_x, determinant_)};
    shift.explained = by_pixel(kSumOfProducts, shift.x, to_x, shift.y, to_y);
    shift.change = windowed_products(change.x, change.x, change.y, change.y);
    return shift;
  }

 private:
  static constexpr auto kSumOfProducts = [](float a, float b, float c, float d) { return a * b + c * d; };

  [[nodiscard]] cv::Mat windowed(const cv::Mat& values) const { return window_means(values.mul(weight_)); }

  // windowed(a * b + c * d)
  [[nodiscard]] cv::Mat windowed_products(const cv::Mat& a, const cv::Mat& b, const cv::Mat& c,
                                          const cv::Mat& d) const {
    const auto weighted = [](float va, float vb, float vc, float vd, float weight) {
      return (va * vb + vc * vd) * weight;
    };
    return window_means(by_pixel(weighted, a, b, c, d, weight_));
  }

  [[nodiscard]] static cv::Mat window_means(const cv::Mat& values) {
    cv::Mat means;
    cv::boxFilter(values, means, CV_32F, {kShiftWindow, kShiftWindow}, {-1, -1}, true, cv::BORDER_REFLECT);
    return means;
  }

  cv::Mat weight_;
  Slope slope_;
  cv::Mat second_xx_, second_xy_, second_yy_;
  cv::Mat xx_, xy_, yy_, determinant_;
  cv::Mat slope_square_;
};

// Pixels close to what moves get little weight too: there, what moves shows through a blurred border.
cv::Mat weight_of(const cv::Mat& ratio) {
  cv::Mat near;
  cv::dilate(ratio, near, cv::Mat::ones(kMovingMargin, kMovingMargin, CV_8UC1));
  return shrunk(1.0 / cv::Mat(near.mul(near) + 1.0));
}

cv::Mat mean_of(const std::vector<cv::Mat>& images) {
  cv::Mat sum = cv::Mat::zeros(images.front().size(), CV_32FC1);
  for (const cv::Mat& image : images) sum += image;
  return sum / static_cast<double>(images.size());
}

}  // namespace

FrameAverager::FrameAverager(cv::Size size_px)
    : size_px_(size_px),
      scale_(std::min({(size_px.width + kMaxWidth - 1) / kMaxWidth, size_px.width, size_px.height})),
      box_(std::min(scale_, kMaxBox)) {
  ENSURE(size_px.width > 0 && size_px.height > 0);
  sum_ = cv::Mat::zeros(size_px.height / scale_, size_px.width / scale_, CV_16UC1);
}

void FrameAverager::add(const cv::Mat& luma) {
  ENSURE(luma.type() == CV_8UC1 && luma.size() == size_px_ && !is_full());
  for (int y = 0; y < sum_.rows; ++y)
    for (int k = 0; k < box_; ++k) {
      const auto* from = luma.ptr<std::uint8_t>(y * scale_ + k);
      auto* to = sum_.ptr<std::uint16_t>(y);
      if (scale_ == 1) add_row(from, to, sum_.cols);
      if (scale_ == 2) add_row_of_pairs(from, to, sum_.cols);
      if (scale_ > 2) add_row_of_boxes(from, to, sum_.cols, scale_, box_);
    }
  ++frames_;
  ++waiting_;
}

bool FrameAverager::is_full() const {
  const int before = frames_ - waiting_;
  return waiting_ >= std::clamp(before / kMeansAtFirst, 1, kMaxFramesPerMean);
}

MeanFrame FrameAverager::image() const {
  ENSURE(waiting_ > 0);
  MeanFrame image{.frames = waiting_};
  sum_.convertTo(image.luma, CV_32F, 1.0 / (waiting_ * box_ * box_));
  return image;
}

void FrameAverager::clear() {
  sum_.setTo(0);
  waiting_ = 0;
}

void FootageSegments::add(const MeanFrame& image) {
  append(segments_, image, max_frames_);
  while (segments_.size() > kMaxSegments) {
    max_frames_ *= 2;
    std::vector<MeanFrame> longer;
    for (const MeanFrame& segment : segments_) append(longer, segment, max_frames_);
    segments_ = std::move(longer);
  }
}

cv::Mat drifting(const std::vector<MeanFrame>& segments, const cv::Mat& ratio) {
  ENSURE(!segments.empty());
  std::vector<cv::Mat> images;
  for (const MeanFrame& segment : segments) images.push_back(small_image(segment));
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
    const auto with_products = [](float sum, float a, float b, float c, float d) { return sum + (a * b + c * d); };
    if (!before.x.empty()) agreeing = by_pixel(with_products, agreeing, before.x, shift.x, before.y, shift.y);
    square = by_pixel(with_products, square, shift.x, shift.x, shift.y, shift.y);
    explained += shift.explained;
    change += shift.change;
    before = std::move(shift);
  }
  const double pairs = std::max(1.0, static_cast<double>(segments.size()) - 1);
  cv::Mat shift;
  cv::sqrt(cv::max(agreeing / pairs, 0.0), shift);
  shift *= kShrink;
  const cv::Mat steady = linear_step(agreeing / square, kChanceAgreement, kSteadyAgreement);
  const cv::Mat is_shift = linear_step(explained / change, kUnexplained, kExplained);
  const cv::Mat drifts = linear_step(shift, kStays_px, kDrifts_px).mul(steady).mul(is_shift);
  cv::Mat full;
  cv::resize(drifts, full, ratio.size(), 0, 0, cv::INTER_LINEAR);
  // Only where all windows around agree: a window at the border of a body contains world too.
  cv::erode(full, full, cv::Mat::ones(kShiftWindow, kShiftWindow, CV_8UC1));
  return full;
}

}  // namespace sigs
