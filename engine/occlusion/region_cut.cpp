// SPDX-License-Identifier: MIT
#include "occlusion/region_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

#include "base/ensure.h"

namespace sigs {

namespace {

// Whole numbers, so that sums do not depend on their order.
constexpr double kUnit = 20000;
constexpr double kBoundaryCost = 0.001;  // of the border's length, on a sure boundary: the shorter of two is the better

constexpr int kSmall = 240;  // pixels: an image as small as this is cut in one go
constexpr int kBand = 4;     // pixels beside a coarser border in which the finer one lies

int whole(double cost) {
  return static_cast<int>(std::lround(cost * kUnit));
}

struct Neighbour {
  int dx, dy;
  double length;  // of border that one crossed link stands for
};

// Eight neighbours, so that a slanting border costs about its length (Boykov and Kolmogorov, 2003).
constexpr std::array<Neighbour, 4> kNeighbours{{{1, 0, 0.55}, {0, 1, 0.55}, {1, 1, 0.27}, {-1, 1, 0.27}}};

double border_cost(float boundary, float other_boundary) {
  const double open = 1 - std::min(1.0, (static_cast<double>(boundary) + other_boundary) / 2);
  return open * open + kBoundaryCost;
}

using Graph = cv::detail::GCGraph<int>;

// What is known before: the labels of pixels that are not free stay.
struct Known {
  cv::Mat labels;  // CV_8UC1
  cv::Mat free;    // CV_8UC1, non-zero: to be labelled
};

cv::Mat numbered(const cv::Mat& free) {
  cv::Mat numbers(free.size(), CV_32SC1, cv::Scalar(-1));
  int count = 0;
  for (int y = 0; y < free.rows; ++y)
    for (int x = 0; x < free.cols; ++x)
      if (free.at<std::uint8_t>(y, x) != 0) numbers.at<int>(y, x) = count++;
  return numbers;
}

void add_link(Graph& graph, const Known& known, const cv::Mat& numbers, cv::Point a, cv::Point b, int cost) {
  const int number_a = numbers.at<int>(a);
  const int number_b = numbers.at<int>(b);
  if (number_a >= 0 && number_b >= 0) graph.addEdges(number_a, number_b, cost, cost);
  if ((number_a >= 0) == (number_b >= 0)) return;
  const bool is_body = known.labels.at<std::uint8_t>(number_a >= 0 ? b : a) != 0;
  graph.addTermWeights(std::max(number_a, number_b), is_body ? cost : 0, is_body ? 0 : cost);
}

cv::Mat cut(const CutCosts& costs, const Known& known) {
  const cv::Rect image({}, costs.boundary.size());
  const cv::Mat numbers = numbered(known.free);
  const auto pixels = static_cast<unsigned>(cv::countNonZero(known.free));
  Graph graph(pixels + 2, (pixels + 1) * 2 * kNeighbours.size());
  for (unsigned i = 0; i < pixels + 2; ++i) graph.addVtx();
  graph.addEdges(static_cast<int>(pixels), static_cast<int>(pixels) + 1, 0, 0);  // no graph without a link is allowed
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const int number = numbers.at<int>(y, x);
      if (number >= 0)
        graph.addTermWeights(number, whole(costs.as_world.at<float>(y, x)), whole(costs.as_body.at<float>(y, x)));
      for (const Neighbour& to : kNeighbours) {
        const cv::Point other(x + to.dx, y + to.dy);
        if (!image.contains(other)) continue;
        const double open = border_cost(costs.boundary.at<float>(y, x), costs.boundary.at<float>(other));
        add_link(graph, known, numbers, {x, y}, other, whole(to.length * open));
      }
    }
  graph.maxFlow();
  cv::Mat labels = known.labels.clone();
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (const int number = numbers.at<int>(y, x); number >= 0)
        labels.at<std::uint8_t>(y, x) = graph.inSourceSegment(number) ? 255 : 0;
  return labels;
}

cv::Mat halved(const cv::Mat& values, cv::Size size) {
  cv::Mat half;
  cv::resize(values, half, size, 0, 0, cv::INTER_AREA);
  return half;
}

// Pixels twice as large: an area's costs are fourfold and a border's length twofold, so that in the larger unit areas
// cost twice as much. A boundary stays a boundary, however thin.
CutCosts halved(const CutCosts& costs) {
  const cv::Size half(costs.boundary.cols / 2, costs.boundary.rows / 2);
  cv::Mat thick;
  cv::dilate(costs.boundary, thick, cv::Mat::ones(2, 2, CV_8UC1), {0, 0});
  CutCosts coarse{halved(costs.as_body, half) * 2, halved(costs.as_world, half) * 2};
  cv::resize(thick, coarse.boundary, half, 0, 0, cv::INTER_NEAREST);
  return coarse;
}

// Pixels near the border of labels.
cv::Mat band_along(const cv::Mat& labels, int radius) {
  const cv::Mat element = cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
  cv::Mat band;
  cv::morphologyEx(labels, band, cv::MORPH_GRADIENT, element);
  return band;
}

}  // namespace

cv::Mat cheapest_cut(const CutCosts& costs) {
  const cv::Size size = costs.boundary.size();
  ENSURE(costs.as_body.size() == size && costs.as_world.size() == size);
  if (size.width < kSmall || size.height < kSmall)
    return cut(costs, {cv::Mat::zeros(size, CV_8UC1), cv::Mat(size, CV_8UC1, cv::Scalar(255))});
  cv::Mat labels;
  cv::resize(cheapest_cut(halved(costs)), labels, size, 0, 0, cv::INTER_NEAREST);
  return cheapest_cut_near(labels, kBand, costs);
}

cv::Mat cheapest_cut_near(const cv::Mat& labels, int radius, const CutCosts& costs) {
  return cut(costs, {labels, band_along(labels, radius)});
}

}  // namespace sigs
