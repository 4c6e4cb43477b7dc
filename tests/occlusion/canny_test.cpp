// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "occlusion/paper.h"
#include "occlusion/synthetic_masks.h"

namespace sigs::test {

namespace {

int sample(const cv::Mat& image, int x, int y) {  // the image's edge is repeated beyond it
  return image.at<uchar>(std::clamp(y, 0, image.rows - 1), std::clamp(x, 0, image.cols - 1));
}

struct Gradient {
  int across = 0;
  int down = 0;
  [[nodiscard]] int squared() const { return across * across + down * down; }
};

Gradient gradient_at(const cv::Mat& p, int x, int y) {
  const auto side = [&](int dx) {
    return sample(p, x + dx, y - 1) + 2 * sample(p, x + dx, y) + sample(p, x + dx, y + 1);
  };
  const auto level = [&](int dy) {
    return sample(p, x - 1, y + dy) + 2 * sample(p, x, y + dy) + sample(p, x + 1, y + dy);
  };
  return {side(1) - side(-1), level(1) - level(-1)};
}

// A ridge of the gradient across the edge's direction, which is taken to the nearest eighth of a turn.
bool on_ridge(const cv::Mat& p, int x, int y) {
  const auto squared = [&](int dx, int dy) {
    const cv::Point at(x + dx, y + dy);
    return cv::Rect({}, p.size()).contains(at) ? gradient_at(p, at.x, at.y).squared() : 0;
  };
  const Gradient gradient = gradient_at(p, x, y);
  const int here = gradient.squared();
  const double steep = std::abs(gradient.down) / std::max(1e-9, std::abs(1.0 * gradient.across));
  // Of two equal neighbours the one to the left, or above, is the ridge.
  if (steep < std::tan(M_PI / 8)) return here > squared(-1, 0) && here >= squared(1, 0);
  if (steep > std::tan(3 * M_PI / 8)) return here > squared(0, -1) && here >= squared(0, 1);
  const int along = (gradient.across < 0) == (gradient.down < 0) ? 1 : -1;
  return here > squared(-along, -1) && here > squared(along, 1);
}

// Canny's own words: ridges above the high threshold, and those above the low one that are connected to them.
cv::Mat edges_by_loops(const cv::Mat& p, const CannyThresholds& thresholds) {
  cv::Mat weak = cv::Mat::zeros(p.size(), CV_8UC1);
  cv::Mat edges = weak.clone();
  for (int y = 0; y < p.rows; ++y)
    for (int x = 0; x < p.cols; ++x) {
      const double length = std::sqrt(gradient_at(p, x, y).squared());
      if (length <= thresholds.low || !on_ridge(p, x, y)) continue;
      weak.at<uchar>(y, x) = 255;
      if (length > thresholds.high) edges.at<uchar>(y, x) = 255;
    }
  for (bool grown = true; grown;) {
    grown = false;
    for (int y = 0; y < p.rows; ++y)
      for (int x = 0; x < p.cols; ++x) {
        if (weak.at<uchar>(y, x) == 0 || edges.at<uchar>(y, x) != 0) continue;
        const cv::Rect around = cv::Rect(x - 1, y - 1, 3, 3) & cv::Rect({}, p.size());
        if (cv::countNonZero(edges(around)) == 0) continue;
        edges.at<uchar>(y, x) = 255;
        grown = true;
      }
  }
  return edges;
}

// The sum of squares within the two parts that a threshold makes of the values.
double spread_within(const std::vector<double>& values, double threshold) {
  double spread = 0;
  for (const bool above : {false, true}) {
    double count = 0;
    double sum = 0;
    double squares = 0;
    for (const double value : values) {
      if ((value > threshold) != above) continue;
      count += 1;
      sum += value;
      squares += value * value;
    }
    if (count > 0) spread += squares - sum * sum / count;
  }
  return spread;
}

}  // namespace

TEST_CASE("the edges are Canny's, by loops over every pixel") {
  constexpr std::array<CannyThresholds, 4> kThresholds = {{{20, 60}, {100, 250}, {37.5, 37.5}, {1, 900}}};
  for (const cv::Size size : small_sizes())
    for (const CannyThresholds& thresholds : kThresholds)
      for (std::uint64_t seed = 0; seed < 4; ++seed) {
        const cv::Mat image = hills(size, 1.5, seed);
        REQUIRE(same_bytes(canny_edges(image, thresholds), edges_by_loops(image, thresholds)));
      }
}

TEST_CASE("no threshold of 256 parts the gradients better than the one found") {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    cv::Mat image = hills({48, 36}, 2, seed);
    if (seed % 2 == 1) image.setTo(0, image < 180);  // few strong edges
    const double found = canny_thresholds(image, {}).high;
    std::vector<double> lengths;
    for (int y = 0; y < image.rows; ++y)
      for (int x = 0; x < image.cols; ++x) lengths.push_back(std::sqrt(gradient_at(image, x, y).squared()));
    const double largest = *std::max_element(lengths.begin(), lengths.end());
    for (double& length : lengths) length = std::nearbyint(length / largest * 255);  // the 256 steps
    const double spread = spread_within(lengths, found / largest * 255);
    for (int step = 0; step < 255; ++step)  // the sums round
      CHECK(spread <= spread_within(lengths, step + 0.5) * (1 + 1e-6));
  }
}

TEST_CASE("thresholds adapt to the image's contrast: half the contrast, half the threshold") {
  const cv::Mat image = hills({60, 40}, 2, 3) & 0xFE;
  const cv::Mat faint = image / 2;
  const CannyThresholds strong = canny_thresholds(image, {});
  const CannyThresholds weak = canny_thresholds(faint, {});
  CHECK(weak.high == doctest::Approx(strong.high / 2).epsilon(1e-6));
  CHECK(weak.low == doctest::Approx(strong.low / 2).epsilon(1e-6));
  CHECK(strong.low == doctest::Approx(0.4 * strong.high).epsilon(1e-9));
  CHECK(same_bytes(canny_edges(image, strong), canny_edges(faint, weak)));
}

TEST_CASE("thresholds that are set are taken, one that is not follows the other") {
  const cv::Mat image = hills({60, 40}, 2, 3);
  const double found = canny_thresholds(image, {}).high;
  const CannyThresholds both = canny_thresholds(image, {.canny_low = 12, .canny_high = 34});
  CHECK(both.low == 12);
  CHECK(both.high == 34);
  const CannyThresholds high = canny_thresholds(image, {.canny_high = 50});
  CHECK(high.low == 20);
  CHECK(high.high == 50);
  const CannyThresholds low = canny_thresholds(image, {.canny_low = 1});
  CHECK(low.low == 1);
  CHECK(low.high == found);
  const CannyThresholds above = canny_thresholds(image, {.canny_low = 2 * found});
  CHECK(above.high == 2 * found);
  const CannyThresholds crossed = canny_thresholds(image, {.canny_low = 80, .canny_high = 40});
  CHECK(crossed.low == 40);
  CHECK(crossed.high == 40);
}

TEST_CASE("an image without gradients has no edges") {
  for (const cv::Size size : small_sizes())
    for (const int value : {0, 255}) {
      const cv::Mat even(size, CV_8UC1, cv::Scalar(value));
      CHECK(cv::countNonZero(canny_edges(even, canny_thresholds(even, {}))) == 0);
    }
}

}  // namespace sigs::test
