// SPDX-License-Identifier: MIT
#include "occlusion/paper.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "base/ensure.h"
#include "occlusion/detect.h"

namespace sigs {

namespace {

// As cv::Canny computes it.
cv::Mat gradient_length(const cv::Mat& image) {
  cv::Mat across;
  cv::Mat down;
  cv::Sobel(image, across, CV_32F, 1, 0, 3, 1, 0, cv::BORDER_REPLICATE);
  cv::Sobel(image, down, CV_32F, 0, 1, 3, 1, 0, cv::BORDER_REPLICATE);
  cv::Mat length;
  cv::magnitude(across, down, length);
  return length;
}

// Otsu's threshold, which minimises the variance within the two classes, on a scale of 256 steps. 0 where all are 0.
double otsu_threshold(const cv::Mat& values) {
  double largest = 0;
  cv::minMaxLoc(values, nullptr, &largest);
  if (largest == 0) return 0;
  cv::Mat steps;
  values.convertTo(steps, CV_8U, 255 / largest);
  cv::Mat unused;
  const double last_below = cv::threshold(steps, unused, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
  return (last_below + 0.5) * largest / 255;
}

int in_proportion(double px_in_the_paper, cv::Size size_px) {
  constexpr int kMin_px = 3;
  constexpr double kDiagonalInThePaper_px = 1600;  // of 1280x960
  const double scale = std::hypot(size_px.width, size_px.height) / kDiagonalInThePaper_px;
  return std::max(kMin_px, static_cast<int>(std::lround(px_in_the_paper * scale)));
}

// The highest pixel that is not black in this column; the mask's height where there is none.
int highest_in(const cv::Mat& mask, int column) {
  int row = 0;
  while (row < mask.rows && mask.at<uchar>(row, column) == 0) ++row;
  return row;
}

void whiten_down_from(cv::Mat& mask, int column, int row) {
  mask(cv::Range(row, mask.rows), cv::Range(column, column + 1)).setTo(255);
}

struct RoughMask {  // section 4.1
  cv::Mat sum;
  cv::Mat canny;
  cv::Mat grown;
  cv::Mat mask;
};

struct RefinedMask {  // section 4.2
  cv::Mat sobel;
  cv::Mat closed_edges;
  cv::Mat with_padding;  // one row and two columns larger
  cv::Mat filled;
  cv::Mat mask;
};

RoughMask rough_mask(const cv::Mat& sum_of_differences, const PaperOwnBodySettings& settings) {
  RoughMask rough;
  rough.sum = normalised_sum(sum_of_differences);
  rough.canny = canny_edges(rough.sum, canny_thresholds(rough.sum, settings));
  rough.grown = dilated(rough.canny, dilation_px(settings, rough.sum.size()));
  rough.mask = contours_filled(rough.grown);
  return rough;
}

RefinedMask refined_mask(const cv::Mat& rough, const PaperOwnBodySettings& settings) {
  RefinedMask refined;
  refined.sobel = sobel_edges(rough);
  refined.closed_edges = closed(refined.sobel, closing_px(settings, rough.size()));
  refined.with_padding = padded(refined.closed_edges);
  refined.filled = unpadded(contours_filled(refined.with_padding));
  refined.mask = without_small(refined.filled, settings.min_area_percent);
  return refined;
}

// A padded mask at the size of the image, with its padding drawn over the edge of the image.
cv::Mat padding_shown(const cv::Mat& with_padding) {
  cv::Mat out = unpadded(with_padding);
  cv::bitwise_or(out.col(0), with_padding(cv::Rect(0, 0, 1, out.rows)), out.col(0));
  cv::bitwise_or(out.col(out.cols - 1), with_padding(cv::Rect(out.cols + 1, 0, 1, out.rows)), out.col(out.cols - 1));
  out.row(out.rows - 1).setTo(255);
  return out;
}

std::vector<DetectionStage> stages_of(const RoughMask& rough, const RefinedMask& refined) {
  return {{"difference_sum", "Sum of normalised differences", rough.sum},
          {"canny", "Canny edges of the sum", rough.canny},
          {"dilated", "Dilated", rough.grown},
          {"rough", "Rough mask: external contours filled", rough.mask},
          {"sobel", "Sobel across and down", refined.sobel},
          {"closed", "Closed", refined.closed_edges},
          {"padded", "Sides and bottom padded", padding_shown(refined.with_padding)},
          {"filled", "Closed contours filled", refined.filled},
          {"refined", "Refined mask: small contours dropped", refined.mask}};
}

cv::Mat confidence_in(const cv::Mat& mask, const PaperOwnBodySettings& settings) {
  constexpr double kSobelReach_px = 1;
  const double border_moves_px = 0.5 * dilation_px(settings, mask.size()) + kSobelReach_px;
  cv::Mat out = signed_distance_px(mask) / (2 * border_moves_px) + 0.5;
  cv::min(out, 1, out);
  cv::max(out, 0, out);
  return out;
}

class PaperMethod final : public DetectionMethod {
 public:
  PaperMethod(const PaperOwnBodySettings& settings, cv::Size size_px)
      : settings_(settings), sum_(cv::Mat::zeros(size_px, CV_32FC1)) {}

  void add(const cv::Mat& luma) override {
    ENSURE(luma.type() == CV_8UC1 && luma.size() == sum_.size());
    if (!previous_.empty()) {
      cv::absdiff(luma, previous_, difference_);
      moved_ |= add_normalised(difference_, sum_);
    }
    luma.copyTo(previous_);
  }

  [[nodiscard]] Verdict verdict(KeepStages keep) const override {
    const RoughMask rough = rough_mask(sum_, settings_);
    const RefinedMask refined = refined_mask(rough.mask, settings_);
    Verdict verdict;
    if (keep == KeepStages::yes) verdict.stages = stages_of(rough, refined);
    if (!moved_) verdict.undecided = "nothing moves: no frame differs from the one before";
    verdict.own_body = moved_ ? refined.mask : cv::Mat::zeros(sum_.size(), CV_8UC1);
    verdict.confidence =
        moved_ ? confidence_in(refined.mask, settings_) : cv::Mat(sum_.size(), CV_32FC1, cv::Scalar(0.5));
    return verdict;
  }

 private:
  PaperOwnBodySettings settings_;
  cv::Mat sum_;  // single precision: after n frames, differences below n / 2^24 of the largest are lost
  cv::Mat previous_;
  cv::Mat difference_;
  bool moved_ = false;
};

}  // namespace

bool add_normalised(const cv::Mat& difference, cv::Mat& sum) {
  ENSURE(difference.type() == CV_8UC1 && sum.type() == CV_32FC1 && difference.size() == sum.size());
  double largest = 0;
  cv::minMaxLoc(difference, nullptr, &largest);
  if (largest == 0) return false;
  const auto scale = static_cast<float>(1 / largest);
  for (int y = 0; y < sum.rows; ++y) {
    const uchar* from = difference.ptr<uchar>(y);
    float* to = sum.ptr<float>(y);
    for (int x = 0; x < sum.cols; ++x) to[x] += static_cast<float>(from[x]) * scale;
  }
  return true;
}

cv::Mat normalised_sum(const cv::Mat& sum) {
  double minimum = 0;
  double largest = 0;
  cv::minMaxLoc(sum, &minimum, &largest);
  if (largest == minimum) return cv::Mat::zeros(sum.size(), CV_8UC1);
  const double scale = 255 / (largest - minimum);
  cv::Mat out;
  sum.convertTo(out, CV_8U, scale, -minimum * scale);
  return out;
}

CannyThresholds canny_thresholds(const cv::Mat& image, const PaperOwnBodySettings& settings) {
  constexpr double kLowToHigh = 0.4;
  double high = settings.canny_high;
  if (high == 0) high = std::max(otsu_threshold(gradient_length(image)), settings.canny_low);
  const double low = settings.canny_low == 0 ? kLowToHigh * high : settings.canny_low;
  return {.low = std::min(low, high), .high = high};
}

cv::Mat canny_edges(const cv::Mat& image, const CannyThresholds& thresholds) {
  ENSURE(thresholds.low <= thresholds.high);
  cv::Mat out;
  constexpr bool kLengthAndNotSumOfAxes = true;
  cv::Canny(image, out, thresholds.low, thresholds.high, 3, kLengthAndNotSumOfAxes);
  return out;
}

int dilation_px(const PaperOwnBodySettings& settings, cv::Size size_px) {
  return settings.dilation_px == 0 ? in_proportion(5, size_px) : settings.dilation_px;
}

int closing_px(const PaperOwnBodySettings& settings, cv::Size size_px) {
  return settings.closing_px == 0 ? in_proportion(9, size_px) : settings.closing_px;
}

// By distances and not by a kernel: the cost does not grow with the diameter.
cv::Mat dilated(const cv::Mat& mask, int diameter_px) {
  return distance_px(mask) <= 0.5 * diameter_px;
}

cv::Mat closed(const cv::Mat& mask, int diameter_px) {
  return distance_px(dilated(mask, diameter_px) == 0) > 0.5 * diameter_px;
}

cv::Mat contours_filled(const cv::Mat& mask) {
  constexpr int kMargin = 1;  // all around, so that the outside is connected
  cv::Mat around;
  cv::copyMakeBorder(mask != 0, around, kMargin, kMargin, kMargin, kMargin, cv::BORDER_CONSTANT, cv::Scalar(0));
  constexpr int kOutside = 128;
  cv::floodFill(around, {0, 0}, cv::Scalar(kOutside), nullptr, {}, {}, 4);
  return around(cv::Rect({kMargin, kMargin}, mask.size())) != kOutside;
}

cv::Mat sobel_edges(const cv::Mat& mask) {
  cv::Mat across;
  cv::Mat down;
  cv::Sobel(mask, across, CV_16S, 1, 0, 3, 1, 0, cv::BORDER_REPLICATE);
  cv::Sobel(mask, down, CV_16S, 0, 1, 3, 1, 0, cv::BORDER_REPLICATE);
  return (across != 0) | (down != 0);
}

cv::Mat padded(const cv::Mat& mask) {
  cv::Mat out;
  cv::copyMakeBorder(mask, out, 0, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  out.row(mask.rows).setTo(255);
  const cv::Rect parts = cv::boundingRect(mask);
  if (parts.empty()) return out;
  whiten_down_from(out, 0, highest_in(mask, parts.x));
  whiten_down_from(out, out.cols - 1, highest_in(mask, parts.br().x - 1));
  return out;
}

cv::Mat unpadded(const cv::Mat& padded_mask) {
  ENSURE(padded_mask.cols > 2 && padded_mask.rows > 1);
  return padded_mask(cv::Rect(1, 0, padded_mask.cols - 2, padded_mask.rows - 1)).clone();
}

cv::Mat without_small(const cv::Mat& mask, double min_area_percent) {
  cv::Mat part_of;
  cv::Mat measures;
  cv::Mat unused;
  const int parts = cv::connectedComponentsWithStats(mask, part_of, measures, unused, 8, CV_32S);
  const double min_px = min_area_percent / 100 * static_cast<double>(mask.total());
  std::vector<uchar> shade(static_cast<std::size_t>(parts), 0);  // part 0 is the black
  for (int part = 1; part < parts; ++part)
    if (measures.at<int>(part, cv::CC_STAT_AREA) >= min_px) shade[static_cast<std::size_t>(part)] = 255;
  cv::Mat out(mask.size(), CV_8UC1);
  for (int y = 0; y < out.rows; ++y)
    for (int x = 0; x < out.cols; ++x) out.at<uchar>(y, x) = shade[static_cast<std::size_t>(part_of.at<int>(y, x))];
  return out;
}

std::unique_ptr<DetectionMethod> paper_method(const PaperOwnBodySettings& settings, cv::Size size_px) {
  return std::make_unique<PaperMethod>(settings, size_px);
}

}  // namespace sigs
