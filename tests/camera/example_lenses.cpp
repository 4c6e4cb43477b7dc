// SPDX-License-Identifier: MIT
#include "camera/example_lenses.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "camera/camera.h"
#include "reference/opencv_lens.h"
#include "support/test_data.h"

namespace sigs::test {

Lens lens_of(LensModel model, double fx, double fy, glm::dvec2 center, std::vector<double> coefficients) {
  auto lens = Lens::make({model, fx, fy, center.x, center.y, std::move(coefficients)});
  REQUIRE(lens.has_value());
  return *std::move(lens);
}

std::vector<ExampleLens> example_lenses() {
  constexpr auto kBrownConrady = LensModel::brown_conrady;
  constexpr auto kKannalaBrandt = LensModel::kannala_brandt;
  const cv::Size vga(640, 480);
  const std::vector<double> oak{-3.4751670360565186, -38.5734748840332,   0.00034309603506699204, 9.377215610584244e-05,
                                286.4400939941406,   -3.6408045291900635, -36.68898010253906,     279.0523681640625};
  const std::vector<double> five{-0.26637, -0.038589, 0.0017832, -0.00028122, 0.23839};
  std::vector<double> twelve = five;
  twelve.insert(twelve.end(), {0.01, -0.02, 0.003, 0.0015, -0.0008, 0.0011, 0.0004});
  std::vector<double> tilted_slightly = twelve;
  tilted_slightly.insert(tilted_slightly.end(), {0.02, -0.015});
  std::vector<double> tilted_far = twelve;
  tilted_far.insert(tilted_far.end(), {0.3, -0.3});
  std::vector<double> tilt_alone(14, 0.0);
  tilt_alone[12] = 0.3;
  return {
      {"pinhole", lens_of(kBrownConrady, 535, 535, {342, 235}, {}), vga},
      {"pinhole with zeros", lens_of(kBrownConrady, 535, 530, {342, 235}, {0, 0, 0, 0, 0}), vga},
      {"4 coefficients", lens_of(kBrownConrady, 535, 535, {342, 235}, {-0.28, 0.07, 0.0018, -0.0003}), vga},
      {"4, pincushion", lens_of(kBrownConrady, 535, 535, {320, 240}, {0.2, 0.05, 0, 0}), vga},
      {"4, strong tangential", lens_of(kBrownConrady, 535, 535, {320, 240}, {-0.1, 0.02, 0.05, -0.08}), vga},
      {"5 coefficients", lens_of(kBrownConrady, 535.9, 535.9, {342.3, 235.6}, five), vga},
      {"5, folds", lens_of(kBrownConrady, 233.6, 233.6, {320, 240}, {-0.32744, 0.12814, 0, 0, -0.023876}), vga},
      {"5, folds, tangential", lens_of(kBrownConrady, 233.6, 233.6, {320, 240}, {-0.3274, 0.1281, 0.01, 0.02, -0.0239}),
       vga},
      {"8, large numbers", lens_of(kBrownConrady, 202.6, 202.6, {124.3, 127.3}, oak), {250, 250}},
      {"8, pole at 45 degrees", lens_of(kBrownConrady, 500, 500, {320, 240}, {0, 0, 0, 0, 0, -1, 0, 0}), vga},
      {"12 coefficients", lens_of(kBrownConrady, 535.9, 535.9, {342.3, 235.6}, twelve), vga},
      {"12, strong prism",
       lens_of(kBrownConrady, 500, 500, {320, 240}, {-0.2, 0.05, 0, 0, 0, 0, 0, 0, 0.1, -0.02, 0.05, 0.03}), vga},
      // Distorted so much that Newton's method from the radial answer misses parts of the field.
      {"12, wild",
       lens_of(kBrownConrady, 500, 600, {320, 240},
               {-2.31165, 0.535954, 1.95676, 0.00111828, -5.10527, 0.00055061, 2.78996, 1.27892, 1.88511, -1.49008,
                -6.21959, 0.0733618}),
       vga},
      {"14 coefficients", lens_of(kBrownConrady, 535.9, 535.9, {342.3, 235.6}, tilted_slightly), vga},
      {"14, tilted far", lens_of(kBrownConrady, 535.9, 535.9, {342.3, 235.6}, tilted_far), vga},
      {"14, tilt alone", lens_of(kBrownConrady, 400, 400, {320, 240}, tilt_alone), vga},
      {"fx ten times fy", lens_of(kBrownConrady, 5000, 500, {320, 240}, five), vga},
      {"principal point outside", lens_of(kBrownConrady, 500, 500, {-300, 900}, {-0.2, 0.05, 0.001, 0.002}), vga},
      {"fisheye",
       lens_of(kKannalaBrandt, 558.3, 558.4, {636.6, 469.5}, {0.05294, 0.008357, 0.003, -0.0035}),
       {1280, 960}},
      {"fisheye of 200 degrees",
       lens_of(kKannalaBrandt, 260, 260, {480, 480}, {-0.01, 0.002, -0.0003, 0.00001}),
       {960, 960}},
      {"fisheye without coefficients", lens_of(kKannalaBrandt, 100, 100, {320, 240}, {0, 0, 0, 0}), vga},
      {"omnidirectional",  // of a real camera of 360 degrees, reduced
       lens_of(LensModel::omnidirectional, 314.4, 314.6, {316.3, 318.5},
               {0.954589, -0.0226039, 0.00166804, 0.000179964, 0.000436136, 0.000472}),
       {640, 640}},
      {"omnidirectional, a hyperbolic mirror",
       lens_of(LensModel::omnidirectional, 400, 405, {320, 240}, {0.7, -0.2, 0.05, 0.002, -0.001}), vga},
      {"omnidirectional beyond a parabola",
       lens_of(LensModel::omnidirectional, 700, 700, {320, 240}, {1.6, 0.05, -0.02, 0.0005, 0.001}), vga},
      {"omnidirectional without distortion", lens_of(LensModel::omnidirectional, 500, 500, {320, 240}, {1.2}), vga},
      {"omnidirectional as flat as a pinhole", lens_of(LensModel::omnidirectional, 500, 500, {320, 240}, {0}), vga},
      {"double sphere of 195 degrees",
       lens_of(LensModel::double_sphere, 313.2, 313.2, {638.7, 514.3}, {-0.1828, 0.5916}),
       {1280, 1024}},
      {"double sphere", lens_of(LensModel::double_sphere, 350, 352, {320, 240}, {0.3, 0.45}), vga},
      {"extended unified", lens_of(LensModel::extended_unified, 380, 381, {320, 240}, {0.62, 1.08}), vga},
      {"extended unified, narrow", lens_of(LensModel::extended_unified, 500, 500, {320, 240}, {0.3, 0.8}), vga},
      {"fisheye that folds", lens_of(kKannalaBrandt, 300, 310, {320, 240}, {-0.1, -0.05, 0.01, 0}), vga},
  };
}

std::vector<ExampleLens> real_lenses() {
  namespace fs = std::filesystem;
  std::vector<ExampleLens> lenses;
  if (!fs::is_directory(real_data() / "calibrations")) return lenses;
  for (const auto& entry : fs::directory_iterator(real_data() / "calibrations")) {
    const fs::path& path = entry.path();
    auto camera = read_calibration(path);
    if (!camera) camera = read_calibration(path, cv::Size(640, 480));
    INFO(path);
    REQUIRE(camera.has_value());
    lenses.push_back({path.filename().string(), camera->lens, camera->size_px});
  }
  std::ranges::sort(lenses, {}, &ExampleLens::name);
  return lenses;
}

std::vector<ExampleLens> all_lenses() {
  std::vector<ExampleLens> lenses = example_lenses();
  std::ranges::move(real_lenses(), std::back_inserter(lenses));
  return lenses;
}

glm::dvec3 direction(double from_axis_rad, double turn_rad) {
  const double off_axis = std::sin(from_axis_rad);
  return {std::cos(from_axis_rad), off_axis * std::cos(turn_rad), off_axis * std::sin(turn_rad)};
}

std::vector<glm::dvec3> directions_over(const Lens& lens, int rings, int spokes, double share) {
  std::vector<glm::dvec3> directions{{1, 0, 0}};
  for (int ring = 1; ring <= rings; ++ring)
    for (int spoke = 0; spoke < spokes; ++spoke)
      directions.push_back(direction(share * lens.valid_angle_rad() * ring / rings,
                                     2 * std::numbers::pi * (spoke + 0.5 * (ring % 2)) / spokes));
  return directions;
}

std::vector<glm::dvec2> opencv_pixels(const Lens& lens, const std::vector<glm::dvec3>& p_in_camera) {
  std::vector<cv::Point3d> points;
  for (const glm::dvec3& p : p_in_camera) points.emplace_back(p.y, p.z, p.x);
  std::vector<glm::dvec2> pixels;
  for (const cv::Point2d& pixel : truth::OpencvLens(lens.parameters()).pixels(points))
    pixels.emplace_back(pixel.x, pixel.y);
  return pixels;
}

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace sigs::test
