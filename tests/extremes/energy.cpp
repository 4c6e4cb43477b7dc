// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <string>
#include <vector>

#include "extremes/validity.h"

namespace sigs::test {
namespace {

struct LensCase {
  std::string name;
  cv::Matx33d matrix;
  std::vector<double> coefficients;
  bool is_fisheye = false;
};

std::vector<LensCase> lens_cases() {
  const cv::Matx33d square(300, 0, 159.5, 0, 300, 119.5, 0, 0, 1);
  return {{"pinhole", square, {0, 0, 0, 0}},
          {"barrel", square, {-0.32, 0.12, 0, 0}},
          {"pincushion", square, {0.2, 0.05, 0, 0}},
          {"tangential", square, {-0.1, 0.02, 0.03, -0.02}},
          {"rational", square, {0.5, 0.1, 0.001, -0.001, 0.02, 0.9, 0.2, 0.05}},
          {"stretched", {330, 0, 150, 0, 110, 110, 0, 0, 1}, {-0.05, 0, 0, 0}},
          {"fisheye of 170 degrees", {107.5, 0, 159.5, 0, 107.5, 119.5, 0, 0, 1}, {0, 0, 0, 0}, true},
          {"warped fisheye", {130, 0, 150, 0, 120, 125, 0, 0, 1}, {0.05, -0.01, 0.002, -0.0003}, true}};
}

// Rays of pixels by OpenCV alone, x right, y down, z forward; not of one length.
std::vector<cv::Vec3d> rays_of(const LensCase& lens, const std::vector<cv::Point2d>& pixels) {
  const cv::TermCriteria stop(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 200, 1e-14);
  std::vector<cv::Point2d> slopes;
  if (lens.is_fisheye)
    cv::fisheye::undistortPoints(pixels, slopes, lens.matrix, lens.coefficients);
  else
    cv::undistortPoints(pixels, slopes, lens.matrix, lens.coefficients, cv::noArray(), cv::noArray(), stop);
  std::vector<cv::Vec3d> rays;
  for (const cv::Point2d& slope : slopes) rays.emplace_back(slope.x, slope.y, 1);
  return rays;
}

// Of the triangle between three directions (Van Oosterom and Strackee 1983, equation 8).
double solid_angle_sr(const cv::Vec3d& a, const cv::Vec3d& b, const cv::Vec3d& c) {
  const double above = std::abs(a.dot(b.cross(c)));
  const double below = cv::norm(a) * cv::norm(b) * cv::norm(c) + a.dot(b) * cv::norm(c) + a.dot(c) * cv::norm(b) +
                       b.dot(c) * cv::norm(a);
  return 2 * std::atan2(above, below);
}

// Light of the layer through each pixel's solid angle, and its silhouette's.
using Energy = std::array<double, 5>;

Energy energy_of(const Layer& layer, const std::vector<cv::Vec3d>& rays_at_corners) {
  Energy energy{};
  const auto row = static_cast<std::size_t>(layer.rect.width + 1);
  for (int y = 0; y < layer.rect.height; ++y)
    for (int x = 0; x < layer.rect.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * row + static_cast<std::size_t>(x);
      const cv::Vec3d& upper_left = rays_at_corners[i];
      const cv::Vec3d& lower_right = rays_at_corners[i + row + 1];
      const double sr = solid_angle_sr(upper_left, rays_at_corners[i + 1], lower_right) +
                        solid_angle_sr(upper_left, rays_at_corners[i + row], lower_right);
      const cv::Vec4f& color = layer.color.at<cv::Vec4f>(y, x);
      for (std::size_t c = 0; c < 4; ++c) energy[c] += sr * color[static_cast<int>(c)];
      energy[4] += sr * layer.coverage.at<float>(y, x);
    }
  return energy;
}

std::vector<cv::Point2d> corners_of(const cv::Rect& rect) {
  std::vector<cv::Point2d> corners;
  for (int y = 0; y <= rect.height; ++y)
    for (int x = 0; x <= rect.width; ++x) corners.emplace_back(rect.x + x - 0.5, rect.y + y - 0.5);
  return corners;
}

Energy energy_of(const RenderedView& drawn) {
  std::vector<cv::Vec3d> rays;
  for (const cv::Point2d& corner : corners_of(drawn.layer.rect))
    rays.emplace_back((corner.x - drawn.view.center_px.x) / drawn.view.focal_px,
                      (corner.y - drawn.view.center_px.y) / drawn.view.focal_px, 1);
  return energy_of(drawn.layer, rays);
}

// Before the camera, with all of the aircraft within the image.
std::vector<glm::dvec3> targets() {
  return {{55, 0, 0}, {60, 15, -9}, {70, -20, 12}};
}

}  // namespace

TEST_CASE("the warp keeps the light of the rendered view within a thousandth through every lens") {
  for (const LensCase& lens : lens_cases())
    for (const glm::dvec3& from_eye_m : targets()) {
      CAPTURE(lens.name);
      CAPTURE(from_eye_m.y);
      Scenario scenario;
      set_lens(scenario, lens.matrix, lens.coefficients, lens.is_fisheye);
      add_aircraft(scenario, kEye_m + from_eye_m);
      const ValidFrame valid = valid_frame(scenario.opened(), 1, even_frame(scenario.size_px(), 100));
      const IntruderLayers& layers = valid.layers[0];
      REQUIRE(layers.views.size() == 1);
      REQUIRE(valid.composed.truth.intruders[0].visible_fraction > 0.99);  // wholly in the image
      const Energy rendered = energy_of(layers.views[0]);
      const Energy warped = energy_of(layers.warped, rays_of(lens, corners_of(layers.warped.rect)));
      for (std::size_t c = 0; c < rendered.size(); ++c) {
        CAPTURE(c);
        CHECK(warped[c] == doctest::Approx(rendered[c]).epsilon(0.001));
      }
    }
}

TEST_CASE("the blur keeps the light of the warped layer within a thousandth through every lens") {
  for (const LensCase& lens : lens_cases())
    for (const double sigma_px : {1e-6, 0.3, 1.0, 4.0, 15.0, 20.0}) {
      CAPTURE(lens.name);
      CAPTURE(sigma_px);
      Scenario scenario;
      set_lens(scenario, lens.matrix, lens.coefficients, lens.is_fisheye);
      add_aircraft(scenario, kEye_m + glm::dvec3(120, 0, 0));
      scenario.project.compositing.blur_px_per_m = sigma_px / 120;
      const ValidFrame valid = valid_frame(scenario.opened(), 1, even_frame(scenario.size_px(), 100));
      const IntruderLayers& layers = valid.layers[0];
      const cv::Scalar before = cv::sum(layers.warped.color);
      const cv::Scalar after = cv::sum(layers.blurred.color);
      for (int c = 0; c < 4; ++c) CHECK(after[c] == doctest::Approx(before[c]).epsilon(0.001));
      CHECK(cv::sum(layers.blurred.coverage)[0] == doctest::Approx(cv::sum(layers.warped.coverage)[0]).epsilon(1e-6));
    }
}

}  // namespace sigs::test
