// SPDX-License-Identifier: MIT
#include "occlusion/body_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "base/ensure.h"

namespace sigs {

namespace {

// What a part's evidence says for it, in natural logarithms of odds. Each says nothing at its first number, between
// what aircraft's parts and others show, and counts as one unit at the second's distance from there. None decides
// alone: a rim that is sharp all around outweighs some unrest inside.
constexpr double kLoneRim =
    0.55;  // boundaries in the rim over those just outside: a sky's or a texture's own boundaries are
constexpr double kLoneRimUnit = 0.1;  // as many beside the rim as in it, and a world passing by shows hardly any
constexpr double kEdgedRim = 0.6;     // of the rim, by edges that stay; abrupt ends of motion count half
constexpr double kEdgedRimUnit = 0.2;
constexpr double kRestlessness = 3;  // times noise, the median inside; one unit for each doubling above
constexpr double kDriftUnit = 0.25;  // the mean inside, above none
constexpr double kMinOdds = 0.5;
constexpr double kNever = -100;
constexpr double kRivalry = 0.6;  // odds by which a part may be behind an overlapping one and still add to it

constexpr double kNext = 1.5;    // pixels: the eight next to one are less far away, the others farther
constexpr int kBandShare = 160;  // of the width: that far off the rim, what it is made of no longer shows
constexpr int kBandWidth = 2;    // times that

cv::Mat square(int radius) {
  return cv::Mat::ones(2 * radius + 1, 2 * radius + 1, CV_8UC1);
}

double median(const cv::Mat& values, const cv::Mat& mask) {
  std::vector<float> sorted;
  for (int y = 0; y < values.rows; ++y)
    for (int x = 0; x < values.cols; ++x)
      if (mask.at<std::uint8_t>(y, x) != 0) sorted.push_back(values.at<float>(y, x));
  if (sorted.empty()) return 0;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

// The boundaries' middles may lie on either side of the labels' border.
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

// Where a part and its surroundings are looked at.
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
  const double restless = std::max(1.0, median(variation, zones.inside) / kRestlessness);
  return -std::log2(restless) - cv::mean(drift, zones.inside)[0] / kDriftUnit;
}

cv::Rect grown(const cv::Rect& box, int by, cv::Size size) {
  return cv::Rect(box.x - by, box.y - by, box.width + 2 * by, box.height + 2 * by) & cv::Rect({}, size);
}

bool is_at_border(const cv::Rect& box, cv::Size size) {
  return box.x == 0 || box.y == 0 || box.br().x == size.width || box.br().y == size.height;
}

struct Part {
  cv::Rect box;  // with its surroundings
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
    Part part{.box = grown(box, (1 + kBandWidth) * off + 2, size), .odds = kNever};
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
