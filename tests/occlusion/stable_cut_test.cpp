// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "occlusion/region_cut.h"

namespace {

using namespace sigs;

cv::Mat random_costs(cv::Size size, double maximum, cv::RNG& random) {
  cv::Mat costs(size, CV_32FC1);
  random.fill(costs, cv::RNG::UNIFORM, 0, maximum);
  return costs;
}

double link_cost(const CutCosts& costs, cv::Point a, cv::Point b) {
  const double open = 1 - (costs.boundary.at<float>(a) + costs.boundary.at<float>(b)) / 2;
  return (a.x != b.x && a.y != b.y ? 0.27 : 0.55) * (open * open + 0.001);
}

double cost_of(const CutCosts& costs, const cv::Mat& labels) {
  double sum = 0;
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x) {
      const bool is_body = labels.at<std::uint8_t>(y, x) != 0;
      sum += is_body ? costs.as_body.at<float>(y, x) : costs.as_world.at<float>(y, x);
      for (const cv::Point step : {cv::Point(1, 0), cv::Point(0, 1), cv::Point(1, 1), cv::Point(-1, 1)}) {
        const cv::Point other(x + step.x, y + step.y);
        if (!cv::Rect({}, labels.size()).contains(other)) continue;
        if (is_body != (labels.at<std::uint8_t>(other) != 0)) sum += link_cost(costs, {x, y}, other);
      }
    }
  return sum;
}

double cheapest_of_all(const CutCosts& costs) {
  double cheapest = std::numeric_limits<double>::infinity();
  cv::Mat labels(costs.boundary.size(), CV_8UC1);
  for (unsigned bits = 0; bits < 1U << labels.total(); ++bits) {
    for (unsigned i = 0; i < labels.total(); ++i) labels.data[i] = (bits >> i & 1U) != 0 ? 255 : 0;
    cheapest = std::min(cheapest, cost_of(costs, labels));
  }
  return cheapest;
}

// Around the part, an edge that stays; nothing else.
PartEvidence sure_evidence(cv::Size size, const cv::Rect& part) {
  cv::Mat middle = cv::Mat::zeros(size, CV_32FC1);
  cv::rectangle(middle, part, cv::Scalar(1), 1);
  return {.staying = cv::Mat::ones(size, CV_32FC1),
          .ending = cv::Mat::zeros(size, CV_32FC1),
          .variation = cv::Mat::ones(size, CV_32FC1),
          .drift = cv::Mat::zeros(size, CV_32FC1),
          .middle = middle};
}

}  // namespace

TEST_CASE("no labelling of a small image costs less than the minimum cut") {
  cv::RNG random(7);
  for (int i = 0; i < 40; ++i) {
    const cv::Size size(4, 3);
    const CutCosts costs{random_costs(size, 1.5, random), random_costs(size, 1.5, random),
                         random_costs(size, 1, random)};
    CHECK(std::abs(cost_of(costs, cheapest_cut(costs)) - cheapest_of_all(costs)) < 2e-3);  // 40 costs in 1/20000
  }
}

TEST_CASE("a body behind a boundary is found whole in a large image from weak hints, to the pixel") {
  const cv::Rect body(200, 260, 240, 220);
  CutCosts costs{cv::Mat(480, 640, CV_32FC1, cv::Scalar(0.3)), cv::Mat::zeros(480, 640, CV_32FC1),
                 cv::Mat::zeros(480, 640, CV_32FC1)};
  costs.as_body(body) = 0;
  costs.as_world(body) = 0.01;
  cv::rectangle(costs.boundary, body, 1);
  cv::Mat truth = cv::Mat::zeros(480, 640, CV_8UC1);
  truth(body) = 255;
  CHECK(cv::countNonZero(cheapest_cut(costs) != truth) < 16);  // corners may be cut off
}

TEST_CASE("a cut near given labels changes nothing farther away") {
  cv::Mat labels = cv::Mat::zeros(60, 60, CV_8UC1);
  labels(cv::Rect(20, 20, 20, 20)) = 255;
  const cv::Mat none = cv::Mat::zeros(60, 60, CV_32FC1);
  const cv::Mat all_body = cheapest_cut_near(labels, 3, {none, cv::Mat(60, 60, CV_32FC1, cv::Scalar(9)), none});
  CHECK(all_body.at<std::uint8_t>(18, 30) == 255);
  CHECK(all_body.at<std::uint8_t>(16, 30) == 0);
  const cv::Mat far_off = cheapest_cut_near(cv::Mat::zeros(60, 60, CV_8UC1), 3, {none, none + 9, none});
  CHECK(cv::countNonZero(far_off) == 0);
}

TEST_CASE("a part is kept only at the border, and where its rim and its inside together are evidence for it") {
  const cv::Size size(320, 100);
  cv::Mat labels = cv::Mat::zeros(size, CV_8UC1);
  const cv::Rect part(100, 50, 40, 50);
  labels(part) = 255;
  const PartEvidence sure = sure_evidence(size, part);
  const auto is_kept = [&](const std::function<void(PartEvidence&)>& change) {
    PartEvidence evidence = sure_evidence(size, part);
    change(evidence);
    const BodyParts parts = body_parts({labels}, evidence, 10);
    CHECK(cv::countNonZero(parts.kept | parts.doubtful) == part.area());
    return cv::countNonZero(parts.kept) == part.area();
  };
  CHECK(is_kept([](PartEvidence&) {}));
  CHECK_FALSE(is_kept([](PartEvidence& of) { of.middle = of.middle * 0.2; }));
  CHECK_FALSE(is_kept([](PartEvidence& of) { of.middle = cv::Mat::ones(of.middle.size(), CV_32FC1); }));
  CHECK(is_kept([](PartEvidence& of) {
    of.staying = of.staying * 0;
    of.ending = of.ending + 0.9;
  }));
  CHECK_FALSE(is_kept([](PartEvidence& of) {
    of.staying = of.staying * 0;
    of.middle = of.middle * 0.6;
  }));
  CHECK(is_kept([](PartEvidence& of) { of.variation = of.variation * 8; }));
  CHECK_FALSE(is_kept([](PartEvidence& of) { of.variation = of.variation * 3 * 200; }));
  CHECK(is_kept([](PartEvidence& of) {
    of.drift = of.drift + 0.2;
    of.middle = of.middle * 0.8;
  }));
  CHECK_FALSE(is_kept([](PartEvidence& of) {
    of.drift = of.drift + 0.5;
    of.middle = of.middle * 0.5;
  }));
  CHECK(cv::countNonZero(body_parts({labels}, sure, 3000).kept) == 0);
  cv::Mat floating = cv::Mat::zeros(size, CV_8UC1);
  floating(cv::Rect(100, 20, 40, 50)) = 255;
  CHECK(cv::countNonZero(body_parts({floating}, sure, 10).kept) == 0);
}
