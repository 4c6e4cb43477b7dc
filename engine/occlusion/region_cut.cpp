// SPDX-License-Identifier: MIT
#include "occlusion/region_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>
#include <utility>

#include "base/ensure.h"
#include "base/image.h"
#include "base/statistics.h"
#include "occlusion/detect.h"

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

cv::Mat square(int radius) {
  return cv::Mat::ones(2 * radius + 1, 2 * radius + 1, CV_8UC1);
}

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
  cv::Mat linked;
  cv::dilate(known.free, linked, square(1));  // and the neighbours of free pixels
  const auto pixels = static_cast<unsigned>(cv::countNonZero(known.free));
  Graph graph(pixels + 2, (pixels + 1) * 2 * static_cast<unsigned>(kNeighbours.size()));
  for (unsigned i = 0; i < pixels + 2; ++i) graph.addVtx();
  graph.addEdges(static_cast<int>(pixels), static_cast<int>(pixels) + 1, 0, 0);  // GCGraph needs at least one link
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      if (linked.at<std::uint8_t>(y, x) == 0) continue;
      const int number = numbers.at<int>(y, x);
      if (number >= 0)
        graph.addTermWeights(number, whole(costs.as_world.at<float>(y, x)), whole(costs.as_body.at<float>(y, x)));
      for (const Neighbour& to : kNeighbours) {
        const cv::Point other(x + to.dx, y + to.dy);
        if (!image.contains(other) || (number < 0 && numbers.at<int>(other) < 0)) continue;
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

// How the evidence counts, in natural logarithms of odds: each kind is neutral at its first number, between what parts
// of aircraft and others show, and counts one unit per distance of its second number from there. No kind decides alone:
// an outline that is sharp all around outweighs some motion inside.
//
// Boundaries along the outline less those just outside it: a sky or a texture has as many beside the outline as along
// it, and a world that passes by has hardly any.
constexpr double kLoneRim = 0.55;
constexpr double kLoneRimUnit = 0.1;
// Share of the outline along edges that stay; abrupt ends of motion count half.
constexpr double kEdgedRim = 0.6;
constexpr double kEdgedRimUnit = 0.2;
constexpr double kRestlessness = 3;  // median variation inside, in units of noise; one unit for each doubling above
constexpr double kDriftUnit = 0.25;  // mean drift inside; neutral at 0
constexpr double kMinOdds = 0.5;     // to be kept
constexpr double kNever = -100;      // of parts that do not touch the edge of the image
constexpr double kRivalry = 0.6;  // a part is kept beside an overlapping one whose odds are higher by no more than this

constexpr double kNext = 1.5;  // pixels: between the distance of the eight neighbours of a pixel and that of all others
constexpr int kBandShare =
    160;                       // of the width: at this share of it from the outline, the blur of the outline has ended
constexpr int kBandWidth = 2;  // in units of that distance

double median_in(const cv::Mat& values, const cv::Mat& mask) {
  std::vector<float> inside;
  for (int y = 0; y < values.rows; ++y)
    for (int x = 0; x < values.cols; ++x)
      if (mask.at<std::uint8_t>(y, x) != 0) inside.push_back(values.at<float>(y, x));
  return median(std::move(inside));
}

// The centre lines of boundaries may lie on either side of the border of the labels.
struct Rim {
  cv::Mat middle;
  cv::Mat edged;
};

Rim rim_evidence(const PartEvidence& evidence) {
  Rim rim;
  cv::Mat staying;
  cv::Mat ending;
  cv::dilate(evidence.middle, rim.middle, square(1));
  cv::dilate(evidence.staying, staying, square(1));
  cv::dilate(evidence.ending, ending, square(3));
  rim.edged = (cv::max(staying, ending) + staying) * 0.5;
  return rim;
}

// The pixels by which a part and its surroundings are judged.
struct Zones {
  cv::Mat rim;      // the pixels next to it
  cv::Mat outside;  // a band off the rim
  cv::Mat inside;   // all but what is next to the rim
};

Zones zones_of(const cv::Mat& part, int off) {
  cv::Mat out;
  cv::Mat in;
  cv::distanceTransform(~part, out, cv::DIST_L2, 3);
  cv::distanceTransform(part, in, cv::DIST_L2, 3);
  return {.rim = (out > 0) & (out < kNext),
          .outside = (out > off + 1) & (out <= (1 + kBandWidth) * off + 1),
          .inside = in > off};
}

double odds_of_rim(const Zones& zones, const Rim& rim) {
  if (cv::countNonZero(zones.rim) == 0) return 0;
  const double lone = cv::mean(rim.middle, zones.rim)[0] - cv::mean(rim.middle, zones.outside)[0];
  const double edged = cv::mean(rim.edged, zones.rim)[0];
  return (lone - kLoneRim) / kLoneRimUnit + (edged - kEdgedRim) / kEdgedRimUnit;
}

double odds_of_inside(const Zones& zones, const cv::Mat& variation, const cv::Mat& drift) {
  const double restless = std::max(1.0, median_in(variation, zones.inside) / kRestlessness);
  return -std::log2(restless) - cv::mean(drift, zones.inside)[0] / kDriftUnit;
}

bool is_at_border(const cv::Rect& box, cv::Size size) {
  return box.x == 0 || box.y == 0 || box.br().x == size.width || box.br().y == size.height;
}

struct Part {
  cv::Rect box;  // of the part with its surroundings
  cv::Mat mask;  // CV_8UC1, of the box
  double odds = 0;
};

std::vector<Part> parts_of(const cv::Mat& labels, const PartEvidence& evidence, const Rim& rim, double min_area_px) {
  const cv::Size size = labels.size();
  const int off = std::max(1, size.width / kBandShare);
  cv::Mat numbers;
  cv::Mat boxes;
  cv::Mat middles;
  const int count = cv::connectedComponentsWithStats(labels, numbers, boxes, middles, 8, CV_32S);
  std::vector<Part> parts;
  for (int i = 1; i < count; ++i) {
    const int* row = boxes.ptr<int>(i);
    if (row[cv::CC_STAT_AREA] < min_area_px) continue;
    const cv::Rect box(row[cv::CC_STAT_LEFT], row[cv::CC_STAT_TOP], row[cv::CC_STAT_WIDTH], row[cv::CC_STAT_HEIGHT]);
    Part part{.box = grown(box, (1 + kBandWidth) * off + 2) & cv::Rect({}, size), .odds = kNever};
    part.mask = numbers(part.box) == i;
    const Zones zones = zones_of(part.mask, off);
    if (is_at_border(box, size))
      part.odds = odds_of_rim(zones, {rim.middle(part.box), rim.edged(part.box)}) +
                  odds_of_inside(zones, evidence.variation(part.box), evidence.drift(part.box));
    parts.push_back(std::move(part));
  }
  return parts;
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

BodyParts body_parts(const std::vector<cv::Mat>& labellings, const PartEvidence& evidence, double min_area_px) {
  ENSURE(!labellings.empty());
  const cv::Size size = labellings.front().size();
  const Rim rim = rim_evidence(evidence);
  std::vector<Part> parts;
  for (const cv::Mat& labels : labellings) {
    std::vector<Part> more = parts_of(labels, evidence, rim, min_area_px);
    std::ranges::move(more, std::back_inserter(parts));
  }
  std::ranges::stable_sort(parts, std::greater{}, &Part::odds);
  BodyParts sorted{.kept = cv::Mat::zeros(size, CV_8UC1), .doubtful = cv::Mat::zeros(size, CV_8UC1)};
  cv::Mat best = cv::Mat::zeros(size, CV_32FC1);  // odds of the part that a pixel was first kept with
  for (const Part& part : parts) {
    sorted.doubtful(part.box).setTo(255, part.mask);
    if (part.odds < kMinOdds) continue;
    double rival = 0;
    cv::minMaxLoc(best(part.box), nullptr, &rival, nullptr, nullptr, part.mask);
    if (part.odds < rival - kRivalry) continue;
    sorted.kept(part.box).setTo(255, part.mask);
    best(part.box).setTo(std::max(part.odds, rival), part.mask);
  }
  sorted.doubtful.setTo(0, sorted.kept);
  sorted.odds = best;
  return sorted;
}

}  // namespace sigs
