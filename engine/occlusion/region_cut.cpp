// SPDX-License-Identifier: MIT
#include "occlusion/region_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

#include "base/ensure.h"
#include "occlusion/mask_geometry.h"

namespace sigs {

namespace {

// Costs are whole multiples of 1 / kUnit, so that sums do not depend on their order.
constexpr double kUnit = 20000;
constexpr double kBoundaryCost = 0.001;  // of a border's length on a sure boundary: of two the shorter one is chosen

constexpr int kSmall = 240;  // pixels: smaller images are cut at full size at once
constexpr int kBand = 4;     // pixels beside a coarser border in which the finer one lies

int whole(double cost) {
  return static_cast<int>(std::lround(cost * kUnit));
}

struct Neighbour {
  int dx, dy;
  double length;  // of border that a cut link represents
};

// Eight neighbours, so that a slanting border costs about its length (Boykov and Kolmogorov, 2003).
constexpr std::array<Neighbour, 4> kNeighbours{{{1, 0, 0.55}, {0, 1, 0.55}, {1, 1, 0.27}, {-1, 1, 0.27}}};

double border_cost(float boundary, float other_boundary) {
  const double open = 1 - std::min(1.0, (static_cast<double>(boundary) + other_boundary) / 2);
  return open * open + kBoundaryCost;
}

using Graph = cv::detail::GCGraph<int>;

// A labelling of which only the free pixels are labelled anew.
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
  Graph graph(pixels + 2, (pixels + 1) * 2 * static_cast<unsigned>(kNeighbours.size()));
  for (unsigned i = 0; i < pixels + 2; ++i) graph.addVtx();
  graph.addEdges(static_cast<int>(pixels), static_cast<int>(pixels) + 1, 0, 0);  // GCGraph needs at least one link
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

cv::Mat resized(const cv::Mat& values, cv::Size size) {
  cv::Mat out;
  cv::resize(values, out, size, 0, 0, cv::INTER_AREA);
  return out;
}

// The costs for pixels twice as large: the costs of an area are fourfold and the length of a border is twofold, so that
// in the larger unit an area costs twice as much. A boundary stays a boundary, however thin.
CutCosts halved(const CutCosts& costs) {
  const cv::Size half(costs.boundary.cols / 2, costs.boundary.rows / 2);
  cv::Mat thick;
  cv::dilate(costs.boundary, thick, cv::Mat::ones(2, 2, CV_8UC1), {0, 0});
  CutCosts coarse{resized(costs.as_body, half) * 2, resized(costs.as_world, half) * 2};
  cv::resize(thick, coarse.boundary, half, 0, 0, cv::INTER_NEAREST);
  return coarse;
}

// Pixels within the radius of the border between the labels.
cv::Mat band_along(const cv::Mat& labels, int radius) {
  cv::Mat band;
  cv::morphologyEx(labels, band, cv::MORPH_GRADIENT, disc(radius));
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
