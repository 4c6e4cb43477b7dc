// SPDX-License-Identifier: MIT
#include "horizon/sky_map.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace sigs {

namespace {

constexpr float kDarker_codes = 14;
constexpr float kBrighter_codes = 42;
constexpr float kRough_codes = 2.5F;    // mean slope of luma within a cell, codes a pixel
constexpr float kBeside_codes = 5;      // between neighbours of which one is known as sky
constexpr float kFollowed = 0.12F;      // share by which the sky's luma follows each cell
constexpr int kLookAhead = 5;           // cells
constexpr int kUpperEnd = 2;            // cells: a column's sky begins within these
constexpr float kTopStep_codes = 10;    // between columns: where one part of the upper border ends
constexpr float kTopDarker_codes = 20;  // than the brightest part: ground that reaches the upper border
constexpr double kMinTopPart = 0.1;     // of the width, to be the brightest part
constexpr uchar kSky = 255, kPassed = 128;

struct Cells {
  cv::Mat luma;   // CV_32F, means
  cv::Mat slope;  // CV_32F, means of the gradient's magnitude, codes a pixel
  cv::Mat_<uchar> hidden;
};

Cells cells_of(const cv::Mat& reduced, const cv::Mat& own_body) {
  Cells cells;
  const cv::Size size(reduced.cols / SkyMap::kCell_px, reduced.rows / SkyMap::kCell_px);
  const cv::Mat whole = reduced(cv::Rect(0, 0, size.width * SkyMap::kCell_px, size.height * SkyMap::kCell_px));
  cv::Mat luma, smooth, right, down, slope;
  whole.convertTo(luma, CV_32F);
  cv::resize(luma, cells.luma, size, 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(luma, smooth, {5, 5}, 1.2);
  constexpr double kPerPixel = 1.0 / 8;  // of Sobel's weights
  cv::Sobel(smooth, right, CV_32F, 1, 0, 3, kPerPixel);
  cv::Sobel(smooth, down, CV_32F, 0, 1, 3, kPerPixel);
  cv::magnitude(right, down, slope);
  cv::resize(slope, cells.slope, size, 0, 0, cv::INTER_AREA);
  cells.hidden = cv::Mat_<uchar>(size, uchar{0});
  if (own_body.empty()) return cells;
  cv::Mat share;
  cv::resize(own_body, share, size, 0, 0, cv::INTER_AREA);
  cells.hidden.setTo(255, share > 127);
  return cells;
}

// One column from above.
void scan(const Cells& cells, int x, cv::Mat_<uchar>& sky) {
  const int rows = sky.rows;
  float around = -1;  // luma of the sky so far
  const auto is_like = [&](int y) {
    const float luma = cells.luma.at<float>(y, x);
    return cells.slope.at<float>(y, x) <= kRough_codes &&
           (around < 0 || (luma > around - kDarker_codes && luma < around + kBrighter_codes));
  };
  for (int y = 0; y < rows; ++y) {
    if (cells.hidden(y, x) != 0) continue;
    if (is_like(y)) {
      const float luma = cells.luma.at<float>(y, x);
      around = around < 0 ? luma : around + kFollowed * (luma - around);
      sky(y, x) = kSky;
      continue;
    }
    if (around < 0) return;
    int alike = 0, seen = 0;
    for (int below = y + 1; below <= std::min(y + kLookAhead, rows - 1); ++below)
      ++seen, alike += is_like(below) ? 1 : 0;
    if (2 * alike < std::max(seen, 1)) return;
    sky(y, x) = kPassed;
  }
}

// Columns that begin with sky: parts of the upper border that are divided by steps of luma and are about as bright as
// the brightest. In a tilted image ground may reach the border beside the sky.
std::vector<bool> top_columns(const Cells& cells) {
  struct Part {
    int from = 0, to = 0;
    float luma = 0;
  };
  std::vector<Part> parts;
  const int columns = cells.luma.cols;
  for (int x = 0; x < columns; ++x) {
    const bool goes_on = x > 0 && cells.slope.at<float>(0, x) <= kRough_codes &&
                         std::abs(cells.luma.at<float>(0, x) - cells.luma.at<float>(0, x - 1)) <= kTopStep_codes;
    if (!goes_on) parts.push_back({.from = x, .to = x});
    ++parts.back().to;
    parts.back().luma += cells.luma.at<float>(0, x);
  }
  float brightest = 0;
  for (Part& part : parts) {
    part.luma /= static_cast<float>(part.to - part.from);
    if (part.to - part.from >= kMinTopPart * columns) brightest = std::max(brightest, part.luma);
  }
  std::vector<bool> is_top(static_cast<std::size_t>(columns));
  for (const Part& part : parts)
    for (int x = part.from; x < part.to; ++x)
      is_top[static_cast<std::size_t>(x)] =
          part.luma > brightest - kTopDarker_codes && cells.slope.at<float>(0, x) <= kRough_codes;
  return is_top;
}

// From cells of sky to their neighbours in the same row.
void spread(const Cells& cells, cv::Mat_<uchar>& sky) {
  const auto reach = [&](int y, int from, int to) {
    if (sky(y, to) == kSky || sky(y, from) != kSky || cells.slope.at<float>(y, to) > kRough_codes) return;
    if (std::abs(cells.luma.at<float>(y, to) - cells.luma.at<float>(y, from)) < kBeside_codes &&
        cells.hidden(y, to) == 0)
      sky(y, to) = kSky;
  };
  for (int y = 0; y < sky.rows; ++y) {
    for (int x = 1; x < sky.cols; ++x) reach(y, x - 1, x);
    for (int x = sky.cols - 1; x > 0; --x) reach(y, x, x - 1);
  }
}

}  // namespace

bool SkyMap::is_sky(double x_px, double y_px) const {
  if (empty()) return false;
  const int x = std::clamp(static_cast<int>(x_px) / kCell_px, 0, sky.cols - 1);
  const int y = std::clamp(static_cast<int>(y_px) / kCell_px, 0, sky.rows - 1);
  return sky(y, x) == kSky;
}

int SkyMap::end_of(int column) const {
  for (int y = sky.rows; y > 0; --y)
    if (sky(y - 1, column) == kSky) return y;
  return 0;
}

SkyMap sky_map_of(const cv::Mat& reduced, const cv::Mat& own_body) {
  SkyMap map;
  if (reduced.cols < SkyMap::kCell_px || reduced.rows < SkyMap::kCell_px) return map;
  const Cells cells = cells_of(reduced, own_body);
  map.sky = cv::Mat_<uchar>(cells.luma.size(), uchar{0});
  const std::vector<bool> is_top = top_columns(cells);
  for (int x = 0; x < map.sky.cols; ++x)
    if (is_top[static_cast<std::size_t>(x)]) scan(cells, x, map.sky);
  spread(cells, map.sky);
  const int free_cells = map.sky.rows * map.sky.cols - cv::countNonZero(cells.hidden);
  map.share = static_cast<double>(cv::countNonZero(map.sky)) / std::max(free_cells, 1);
  cv::Mat top;
  cv::reduce(map.sky.rowRange(0, std::min(map.sky.rows, kUpperEnd + 1)), top, 0, cv::REDUCE_MAX);
  map.columns = static_cast<double>(cv::countNonZero(top)) / map.sky.cols;
  return map;
}

}  // namespace sigs
