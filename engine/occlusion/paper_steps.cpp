// SPDX-License-Identifier: MIT
#include "occlusion/paper_steps.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "base/ensure.h"
#include "occlusion/soft_edge.h"

namespace sigs {

namespace {

// As cv::Canny sees it.
cv::Mat gradient_length(const cv::Mat& image) {
  cv::Mat across;
  cv::Mat down;
  cv::Sobel(image, across, CV_32F, 1, 0, 3, 1, 0, cv::BORDER_REPLICATE);
  cv::Sobel(image, down, CV_32F, 0, 1, 3, 1, 0, cv::BORDER_REPLICATE);
  cv::Mat length;
  cv::magnitude(across, down, length);
  return length;
}

// Parts the values in two so that the variance within the parts is least; on a scale of 256 steps. 0 where all are 0.
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
  constexpr int kLeast_px = 3;
  constexpr double kDiagonalInThePaper_px = 1600;  // of 1280x960
  const double scale = std::hypot(size_px.width, size_px.height) / kDiagonalInThePaper_px;
  return std::max(kLeast_px, static_cast<int>(std::lround(px_in_the_paper * scale)));
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
  double least = 0;
  double largest = 0;
  cv::minMaxLoc(sum, &least, &largest);
  if (largest == least) return cv::Mat::zeros(sum.size(), CV_8UC1);
  const double scale = 255 / (largest - least);
  cv::Mat out;
  sum.convertTo(out, CV_8U, scale, -least * scale);
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
  constexpr int kFree = 1;  // all around, for the way from outside to lead everywhere
  cv::Mat around;
  cv::copyMakeBorder(mask != 0, around, kFree, kFree, kFree, kFree, cv::BORDER_CONSTANT, cv::Scalar(0));
  constexpr int kOutside = 128;
  cv::floodFill(around, {0, 0}, cv::Scalar(kOutside), nullptr, {}, {}, 4);
  return around(cv::Rect({kFree, kFree}, mask.size())) != kOutside;
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

cv::Mat without_small(const cv::Mat& mask, double least_area_percent) {
  cv::Mat part_of;
  cv::Mat measures;
  cv::Mat unused;
  const int parts = cv::connectedComponentsWithStats(mask, part_of, measures, unused, 8, CV_32S);
  const double min_px = least_area_percent / 100 * static_cast<double>(mask.total());
  std::vector<uchar> shade(static_cast<std::size_t>(parts), 0);  // part 0 is the black
  for (int part = 1; part < parts; ++part)
    if (measures.at<int>(part, cv::CC_STAT_AREA) >= min_px) shade[static_cast<std::size_t>(part)] = 255;
  cv::Mat out(mask.size(), CV_8UC1);
  for (int y = 0; y < out.rows; ++y)
    for (int x = 0; x < out.cols; ++x) out.at<uchar>(y, x) = shade[static_cast<std::size_t>(part_of.at<int>(y, x))];
  return out;
}

}  // namespace sigs
