// SPDX-License-Identifier: MIT
#include "editor/document/mask_painting.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace sigs::editor;

namespace {

const cv::Size kMaskSize{64, 48};

cv::Mat empty_mask() {
  return cv::Mat::zeros(kMaskSize, CV_8UC1);
}

// The brush's definition, pixel by pixel over the whole image.
cv::Mat dot_by_definition(const Brush& brush, const glm::dvec2& at) {
  cv::Mat mask = empty_mask();
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) {
      const double distance_px = std::hypot(x - at.x, y - at.y);
      const double inner = brush.radius_px - brush.edge_px / 2;
      const double outer = brush.radius_px + brush.edge_px / 2;
      double share = (outer - distance_px) / (outer - inner);
      if (distance_px <= inner) share = 1;
      if (distance_px >= outer && outer > inner) share = 0;
      if (distance_px > inner && outer == inner) share = 0;
      mask.at<uchar>(y, x) = static_cast<uchar>(std::lround(255 * share));
    }
  return mask;
}

int max_apart(const cv::Mat& a, const cv::Mat& b) {
  return static_cast<int>(cv::norm(a, b, cv::NORM_INF));
}

}  // namespace

TEST_CASE("a stroke of no length is a dot, exactly round") {
  for (const double radius_px : {0.5, 1.0, 3.3, 10.0, 21.7})
    for (const double edge_px : {0.0, 1.0, 2.5, 12.0})
      for (const glm::dvec2 at :
           {glm::dvec2(31, 20), glm::dvec2(31.25, 20.75), glm::dvec2(2, 46), glm::dvec2(-4, 10)}) {
        CAPTURE(radius_px);
        CAPTURE(edge_px);
        const Brush brush{radius_px, edge_px};
        cv::Mat mask = empty_mask();
        move_brush(mask, brush, at, at);
        CHECK(max_apart(mask, dot_by_definition(brush, at)) <= (edge_px > 0 ? 1 : 0));  // rounded from other sums
      }
}

TEST_CASE("a line is what dots close to each other along it cover") {
  const std::vector<std::pair<glm::dvec2, glm::dvec2>> lines{
      {{10, 10}, {50, 35}}, {{50, 35}, {10, 10}}, {{8.5, 40}, {60, 40}}, {{20, 5}, {20, 44}}, {{-30, 60}, {90, -20}}};
  for (const auto& [from, to] : lines) {
    const Brush brush{5, 3};
    cv::Mat line = empty_mask();
    move_brush(line, brush, from, to);
    cv::Mat dots = empty_mask();
    constexpr int kDots = 4000;
    for (int i = 0; i <= kDots; ++i) {
      const glm::dvec2 at = from + (to - from) * (double(i) / kDots);
      move_brush(dots, brush, at, at);
    }
    CHECK(max_apart(line, dots) <= 1);  // dots lie up to 0.02 px from the nearest point: 85 * 0.0001 of a code
    CHECK(cv::countNonZero(line) > 100);
  }
}

TEST_CASE("the soft edge is as wide as it says, half covered at the radius") {
  const Brush brush{10, 4};
  CHECK(covered(brush, 0) == 1);
  CHECK(covered(brush, 8) == 1);
  CHECK(covered(brush, 10) == doctest::Approx(0.5));
  CHECK(covered(brush, 11) == doctest::Approx(0.25));
  CHECK(covered(brush, 12) == 0);
  CHECK(covered({10, 0}, 10) == 1);
  CHECK(covered({10, 0}, 10.0001) == 0);
}

TEST_CASE("erasing takes away what painting would give, and no brush goes beyond the other's limits") {
  const Brush paint{9, 2};
  const Brush erase{9, 2, true};
  cv::Mat painted = empty_mask();
  move_brush(painted, paint, {20, 20}, {40, 30});
  cv::Mat erased(kMaskSize, CV_8UC1, cv::Scalar(255));
  move_brush(erased, erase, {20, 20}, {40, 30});
  CHECK(cv::norm(painted + erased, cv::Mat(kMaskSize, CV_8UC1, cv::Scalar(255)), cv::NORM_INF) == 0);
  cv::Mat grey(kMaskSize, CV_8UC1, cv::Scalar(100));
  move_brush(grey, paint, {20, 20}, {40, 30});
  double minimum = 0;
  cv::minMaxLoc(grey, &minimum);
  CHECK(minimum == 100);
}

TEST_CASE("passing twice changes nothing more, and a line in pieces is the line") {
  for (const bool erases : {false, true}) {
    const Brush brush{6, 5, erases};
    const cv::Mat start(kMaskSize, CV_8UC1, cv::Scalar(erases ? 255 : 0));
    cv::Mat once = start.clone();
    move_brush(once, brush, {5, 5}, {55, 40});
    cv::Mat twice = once.clone();
    move_brush(twice, brush, {55, 40}, {5, 5});
    CHECK(max_apart(once, twice) <= 1);  // the other end's sums round otherwise
    cv::Mat pieces = start.clone();
    move_brush(pieces, brush, {5, 5}, {30, 22.5});
    move_brush(pieces, brush, {30, 22.5}, {55, 40});
    CHECK(max_apart(once, pieces) <= 1);
  }
}

TEST_CASE("only pixels of the rectangle that is changed have changed, and all of it lies in the image") {
  const Brush brush{7, 3};
  const std::vector<std::pair<glm::dvec2, glm::dvec2>> lines{
      {{10, 10}, {30, 20}}, {{-3, -3}, {5, 5}}, {{60, 40}, {200, 300}}, {{31.5, 23.5}, {31.5, 23.5}}};
  for (const auto& [from, to] : lines) {
    cv::Mat mask = empty_mask();
    const cv::Rect changed = move_brush(mask, brush, from, to);
    REQUIRE_FALSE(changed.empty());
    CHECK((changed & cv::Rect({0, 0}, kMaskSize)) == changed);
    CHECK(cv::countNonZero(mask) == cv::countNonZero(mask(changed)));
    CHECK(cv::countNonZero(mask) > 0);
  }
}

TEST_CASE("nothing is painted outside the image, far away or at positions that are not finite") {
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<glm::dvec2, glm::dvec2>> lines{
      {{-20, 10}, {-20, 30}}, {{1e7, 1e7}, {1e7, 2e7}},  {{-1e300, 0}, {-1e300, 5}}, {{nan, 5}, {10, 10}},
      {{10, 10}, {5, nan}},   {{infinity, 5}, {10, 10}}, {{10, 10}, {-infinity, 0}}};
  for (const auto& [from, to] : lines) {
    cv::Mat mask = empty_mask();
    CHECK(move_brush(mask, {5, 2}, from, to).empty());
    CHECK(cv::countNonZero(mask) == 0);
  }
  cv::Mat nothing(0, 0, CV_8UC1);
  CHECK(move_brush(nothing, {5, 2}, {0, 0}, {1, 1}).empty());
}

TEST_CASE("a line from very far through the image crosses it") {
  cv::Mat mask = empty_mask();
  move_brush(mask, {4, 0}, {-1e7, 24}, {1e7, 24});
  CHECK(cv::countNonZero(mask.row(24)) == kMaskSize.width);
  CHECK(cv::countNonZero(mask.row(28)) == kMaskSize.width);
  CHECK(cv::countNonZero(mask.row(29)) == 0);
}

TEST_CASE("the radius grows and shrinks in visible steps, within its limits") {
  for (double radius_px = kMinRadius_px; radius_px < kMaxRadius_px;) {
    const double next = stepped_radius_px(radius_px, 1);
    CHECK(next >= std::min(kMaxRadius_px, radius_px + 0.5));
    CHECK(next <= std::min(kMaxRadius_px, std::max(radius_px + 0.5, radius_px * 1.2)));
    CHECK(stepped_radius_px(next, -1) < next);
    radius_px = next;
  }
  CHECK(stepped_radius_px(kMaxRadius_px, 1) == kMaxRadius_px);
  CHECK(stepped_radius_px(kMinRadius_px, -1) == kMinRadius_px);
}
