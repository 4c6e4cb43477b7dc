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
