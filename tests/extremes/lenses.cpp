// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "base/pose.h"
#include "extremes/validity.h"

namespace sigs::test {
namespace {

constexpr double kFocal_px = 300;
const cv::Matx33d kMatrix{kFocal_px, 0, 159.5, 0, kFocal_px, 119.5, 0, 0, 1};
const glm::dvec2 kCenter_px(159.5, 119.5);

glm::dvec2 middle_of(const Box& box) {
  return {box.x + box.width / 2, box.y + box.height / 2};
}

ValidFrame seen_through(Scenario& scenario) {
  return valid_frame(scenario.opened(), 1, grainy_frame(scenario.size_px(), 1));
}

// Mask of what is farther from the lens' axis than so many pixels.
cv::Mat beyond(cv::Size size, const glm::dvec2& center_px, double radius_px) {
  cv::Mat out(size, CV_8UC1);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      out.at<uchar>(y, x) = std::hypot(x - center_px.x, y - center_px.y) > radius_px ? 255 : 0;
  return out;
}

}  // namespace

TEST_CASE("a rational lens whose denominator vanishes has an image up to there and none from beyond") {
  // r -> r / (1 - 4 r^2): to infinity at r = 1/2, and back from minus infinity behind it.
  const std::vector<double> pole{0, 0, 0, 0, 0, -4, 0, 0};
  for (const double slope : {0.1, 0.25, 0.3, 0.5, 0.6, 1.5, 30.0}) {
    CAPTURE(slope);
    Scenario scenario;
    set_lens(scenario, kMatrix, pole);
    add_cube(scenario, 0.02, kEye_m + 10.0 * glm::dvec3(1, slope, 0));
    const ValidFrame valid = seen_through(scenario);
    const IntruderTruth& truth = valid.composed.truth.intruders[0];
    if (slope > 0.51) {
      CHECK(!truth.in_image);
      CHECK(!truth.amodal_box);
    }
    if (slope < 0.4) {
      CHECK(truth.in_image == (slope < 0.32));
      REQUIRE(truth.amodal_box);
      const double x_px = kCenter_px.x + kFocal_px * slope / (1 - 4 * slope * slope);
      // Half the cube's depth of 0.02 in 10 moves its middle by a thousandth of its way, which the pole magnifies.
      CHECK(middle_of(*truth.amodal_box).x == doctest::Approx(x_px).epsilon(0.005));
    }
  }
}

TEST_CASE("a pole that a zero of the numerator all but takes away is valid up to the pole and beyond") {
  // (1 - (4 - 1e-6) r^2) / (1 - 4 r^2): 1 to six digits, except where both are equally small.
  for (const double slope : {0.3, 0.45, 0.499, 0.49999, 0.4999999, 0.5, 0.500001, 0.52}) {
    CAPTURE(slope);
    Scenario scenario;
    set_lens(scenario, kMatrix, {-4 + 1e-6, 0, 0, 0, 0, -4, 0, 0});
    add_aircraft(scenario, kEye_m + 60.0 * glm::dvec3(1, slope, 0));
    const ValidFrame valid = seen_through(scenario);
    if (slope < 0.31) {
      Scenario straight;
      add_aircraft(straight, kEye_m + 60.0 * glm::dvec3(1, slope, 0));
      const Box& box = *valid.composed.truth.intruders[0].amodal_box;
      const Box& wanted = *seen_through(straight).composed.truth.intruders[0].amodal_box;
      CHECK(distance(middle_of(box), middle_of(wanted)) < 1e-3);
    }
  }
}

TEST_CASE("a lens that folds shows nothing beyond its fold and covers all within") {
  // r (1 - r^2 / 2) decreases from r = sqrt(2/3), 163.3 px, on; OpenCV projects points beyond into the image a second
  // time.
  const double fold_px = kFocal_px * std::sqrt(2.0 / 3) * (2.0 / 3);
  for (const double slope : {0.9, 1.2, 1.4}) {
    Scenario scenario;
    set_lens(scenario, kMatrix, {-0.5, 0, 0, 0});
    add_cube(scenario, 1, kEye_m + 30.0 * glm::dvec3(1, slope, 0));
    const ValidFrame valid = seen_through(scenario);
    CHECK(!valid.composed.truth.intruders[0].in_image);
    CHECK(valid.composed.mask.empty());
  }
  Scenario scenario;
  set_lens(scenario, kMatrix, {-0.5, 0, 0, 0});
  scenario.project.compositing.supersampling = 1;
  write_sphere_obj(scenario.path("sphere.obj"), 8);
  scenario.add("sphere.obj", kEye_m);
  const cv::Mat mask = seen_through(scenario).composed.mask;
  REQUIRE(mask.size() == scenario.size_px());
  CHECK(cv::countNonZero((mask != 255) & ~beyond(mask.size(), kCenter_px, fold_px - 2)) == 0);
  CHECK(cv::countNonZero(mask & beyond(mask.size(), kCenter_px, fold_px + 2)) == 0);
}

TEST_CASE("a fisheye of 170 to 200 degrees projects every direction to its angle times the focal length") {
  for (const double field_deg : {170.0, 180.0, 190.0, 200.0})
    for (const double share : {0.0, 0.5, 0.9, 0.97}) {
      CAPTURE(field_deg);
      CAPTURE(share);
      Scenario scenario({320, 320});
      const double half_rad = rad_of_deg(field_deg / 2);
      const double focal_px = 159.5 / half_rad;
      set_lens(scenario, {focal_px, 0, 159.5, 0, focal_px, 159.5, 0, 0, 1}, {0, 0, 0, 0}, true);
      const double angle_rad = share * half_rad;
      add_cube(scenario, 2, kEye_m + 40.0 * glm::dvec3(std::cos(angle_rad), std::sin(angle_rad), 0));
      const ValidFrame valid = seen_through(scenario);
      const IntruderTruth& truth = valid.composed.truth.intruders[0];
      CHECK(truth.in_image);
      REQUIRE(truth.amodal_box);
      // Two metres at 40 are 5 px; a cube's middle is off its outline's by less than a hundredth of that.
      CHECK(distance(middle_of(*truth.amodal_box), {159.5 + focal_px * angle_rad, 159.5}) < 0.1);
      REQUIRE(truth.visible_box);
      CHECK(truth.visible_box->contains(
          {static_cast<int>(std::lround(159.5 + focal_px * angle_rad)), static_cast<int>(159.5)}));
      CHECK(truth.visible_fraction > 0.9);
    }
}

TEST_CASE("an aircraft across the edge of a fisheye's circle and around the camera is valid") {
  for (const double field_deg : {170.0, 200.0})
    for (const double angle_deg : {80.0, 89.9, 90.0, 90.1, 100.0, 120.0, 179.0, 180.0}) {
      CAPTURE(field_deg);
      CAPTURE(angle_deg);
      Scenario scenario({160, 160});
      const double focal_px = 79.5 / rad_of_deg(field_deg / 2);
      set_lens(scenario, {focal_px, 0, 79.5, 0, focal_px, 79.5, 0, 0, 1}, {0, 0, 0, 0}, true);
      scenario.project.compositing.supersampling = 1;
      const double angle_rad = rad_of_deg(angle_deg);
      add_aircraft(scenario, kEye_m + 15.0 * glm::dvec3(std::cos(angle_rad), std::sin(angle_rad), 0));
      (void)seen_through(scenario);
    }
}

TEST_CASE("a principal point outside the image moves the image and nothing else") {
  for (const glm::dvec2& center_px : {glm::dvec2(-200, 500), glm::dvec2(1000, -300), glm::dvec2(159.5, -4000)})
    for (const glm::dvec2& pixel : {glm::dvec2(100, 100), glm::dvec2(5.25, 231.5)}) {
      CAPTURE(center_px.x);
      CAPTURE(pixel.x);
      Scenario scenario;
      set_lens(scenario, {kFocal_px, 0, center_px.x, 0, kFocal_px, center_px.y, 0, 0, 1}, {0, 0, 0, 0});
      const glm::dvec2 slope = (pixel - center_px) / kFocal_px;
      add_plate(scenario, 2, kEye_m + 100.0 * glm::dvec3(1, slope.x, slope.y));
      const ValidFrame valid = seen_through(scenario);
      const IntruderTruth& truth = valid.composed.truth.intruders[0];
      CHECK(truth.in_image);
      REQUIRE(truth.amodal_box);
      // The plate's near face is 6 px wide round the pixel; its far face, 2 cm behind, is drawn 0.02 % nearer the axis.
      CHECK(distance(middle_of(*truth.amodal_box), pixel) < 0.5 * 2e-4 * distance(pixel, center_px) + 1e-3);
      // Of the plate's sides, 2 cm deep, we see what its depth moves the far face by.
      const double sides_px = 6 * kFocal_px * (0.02 / 100) * (std::abs(slope.x) + std::abs(slope.y));
      CHECK(cv::sum(valid.layers[0].warped.coverage)[0] == doctest::Approx(36 + sides_px).epsilon(0.01));
    }
}

TEST_CASE("focal lengths ten times apart stretch the image ten times and keep the area") {
  for (const bool is_wide : {true, false}) {
    CAPTURE(is_wide);
    const glm::dvec2 focal_px = is_wide ? glm::dvec2(1000, 100) : glm::dvec2(100, 1000);
    for (const std::vector<double>& coefficients : {std::vector<double>(4, 0.0), {-0.05, 0, 0.001, -0.001}}) {
      Scenario scenario;
      set_lens(scenario, {focal_px.x, 0, 159.5, 0, focal_px.y, 119.5, 0, 0, 1}, coefficients);
      add_plate(scenario, 6, kEye_m + glm::dvec3(100, 0, 0));
      const ValidFrame valid = seen_through(scenario);
      const IntruderTruth& truth = valid.composed.truth.intruders[0];
      REQUIRE(truth.amodal_box);
      CHECK(truth.amodal_box->width == doctest::Approx(0.06 * focal_px.x).epsilon(0.002));
      CHECK(truth.amodal_box->height == doctest::Approx(0.06 * focal_px.y).epsilon(0.002));
      CHECK(cv::sum(valid.layers[0].warped.coverage)[0] == doctest::Approx(360).epsilon(0.01));
      CHECK(truth.visible_fraction == doctest::Approx(1).epsilon(0.01));
    }
  }
}

}  // namespace sigs::test
