// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <string>

#include "camera/camera.h"
#include "camera/example_lenses.h"
#include "camera/lens_table.h"
#include "support/test_data.h"

// The lens of 360 degree footage: u = (azimuth + pi) / (2 pi) W - 0.5, v = (pi / 2 - elevation) / pi H - 0.5.
namespace sigs::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
const cv::Size kSphere_px(720, 360);  // half a degree a pixel

glm::dvec3 at_azimuth(double azimuth_deg, double elevation_deg) {
  const double a = azimuth_deg * kPi / 180, e = elevation_deg * kPi / 180;
  return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), -std::sin(e)};
}

double apart_px(const std::optional<glm::dvec2>& pixel, const glm::dvec2& expected) {
  REQUIRE(pixel.has_value());
  return glm::length(*pixel - expected);
}

Result<Camera> read_sphere(const std::string& text, std::optional<cv::Size> size = {},
                           std::optional<LensModel> model = {}) {
  const TemporaryFolder folder;
  std::ofstream(folder / "lens.yml") << text;
  return read_calibration(folder / "lens.yml", size, model);
}

}  // namespace

TEST_CASE("columns of a 360 degree image are azimuths, rows are elevations") {
  const Lens lens = equirectangular_camera(kSphere_px).lens;
  CHECK(apart_px(lens.pixel(at_azimuth(0, 0)), {359.5, 179.5}) < 1e-9);
  CHECK(apart_px(lens.pixel(7.5 * at_azimuth(90, 0)), {539.5, 179.5}) < 1e-9);
  CHECK(apart_px(lens.pixel(at_azimuth(-90, 45)), {179.5, 89.5}) < 1e-9);
  CHECK(apart_px(lens.pixel(at_azimuth(179, -30)), {717.5, 239.5}) < 1e-9);
  CHECK(apart_px(lens.pixel(at_azimuth(-179, -30)), {1.5, 239.5}) < 1e-9);
  for (const double elevation_deg : {90.0, -90.0}) {  // a whole row; azimuth 0 of it
    const std::optional<glm::dvec2> pole = lens.pixel({0, 0, elevation_deg > 0 ? -3 : 3});
    CHECK(apart_px(pole, {359.5, elevation_deg > 0 ? -0.5 : 359.5}) < 1e-9);
  }
  for (const glm::dvec3& nowhere : {glm::dvec3(0), glm::dvec3(kInfinity, 0, 0), glm::dvec3(std::nan(""), 0, 1)})
    CHECK_FALSE(lens.pixel(nowhere).has_value());
  CHECK(lens.period_px() == doctest::Approx(720).epsilon(1e-12));
  CHECK(lens.valid_angle_rad() == doctest::Approx(kPi));
}

TEST_CASE("each pixel of a 360 degree image has the ray that leads back to it, on every turn") {
  const Lens lens = equirectangular_camera(kSphere_px).lens;
  for (double v = -0.4; v < 359.5; v += 17.3)
    for (double u = -0.5; u < 719.5; u += 11.7) {
      const auto ray = lens.ray({u, v});
      REQUIRE(ray.has_value());
      CHECK(std::abs(glm::length(*ray) - 1) < 1e-12);
      CHECK(apart_px(lens.pixel(*ray), {u, v}) < 1e-7);  // a step of doubles is 1e-9 px next to a pole
      for (const int turn : {-1, 2}) {
        const auto around = lens.ray({u + 720 * turn, v});
        REQUIRE(around.has_value());
        CHECK(glm::distance(*around, *ray) < 1e-12);
      }
    }
  for (const glm::dvec2& nowhere : {glm::dvec2(0, 1000), glm::dvec2(0, -1000), glm::dvec2(kInfinity, 0)})
    CHECK_FALSE(lens.ray(nowhere).has_value());
}

TEST_CASE("rows beyond a pole show what lies over it") {
  const Lens lens = equirectangular_camera(kSphere_px).lens;
  for (const double u : {0.0, 100.0, 600.0})
    for (const double beyond : {0.5, 3.0, 40.0}) {
      CHECK(glm::distance(*lens.ray({u, -0.5 - beyond}), *lens.ray({u + 360, -0.5 + beyond})) < 1e-12);
      CHECK(glm::distance(*lens.ray({u, 359.5 + beyond}), *lens.ray({u + 360, 359.5 - beyond})) < 1e-12);
    }
}

TEST_CASE("around a direction the columns are in one piece, and the way between pixels is the short one") {
  const Lens lens = equirectangular_camera(kSphere_px).lens;
  const Lens behind = lens.around(at_azimuth(-178, 10));
  const auto left = behind.pixel(at_azimuth(175, 10)), right = behind.pixel(at_azimuth(-175, 10));
  REQUIRE((left && right));
  CHECK(right->x - left->x == doctest::Approx(20));
  CHECK(glm::length(behind.way(*left, *right) - glm::dvec2(20, 0)) < 1e-9);
  CHECK(lens.way({5, 1}, {715, 4}) == glm::dvec2(-10, 3));
  CHECK(glm::length(lens.way({715, 4}, {5, 1}) - glm::dvec2(10, -3)) < 1e-9);
  CHECK(behind.parameters() == lens.parameters());
  const Lens pinhole = lens_of(LensModel::brown_conrady, 500, 500, {320, 240}, {});
  CHECK(pinhole.period_px() == 0);
  CHECK(pinhole.way({5, 1}, {715, 4}) == glm::dvec2(710, 3));
  CHECK(pinhole.around({-1, 0, 0}).pixel({1, 0, 0}) == pinhole.pixel({1, 0, 0}));
}

TEST_CASE("the magnification of a 360 degree image grows with 1 / cos(elevation)") {
  const Lens lens = equirectangular_camera(kSphere_px).lens;
  const double px_per_rad = 360 / kPi;
  for (const double elevation_deg : {0.0, 60.0, -60.0, 85.0})
    CHECK(lens.pixels_per_radian(at_azimuth(20, elevation_deg)) ==
          doctest::Approx(px_per_rad / std::cos(elevation_deg * kPi / 180)).epsilon(1e-9));
  CHECK(std::isfinite(lens.pixels_per_radian({0, 0, -1})));
}

TEST_CASE("the table of a 360 degree lens is exact to its tolerance, beyond the sides and over the poles too") {
  const Camera camera = equirectangular_camera(kSphere_px);
  LensTable table(camera);
  double worst_rad = 0;
  for (int y = -70; y <= 430; y += 3) {
    const std::span<const glm::dvec3> rays = table.corner_rays(-200, y, 1100);
    for (int i = 0; i < 1100; ++i)
      worst_rad =
          std::max(worst_rad, angle_between(rays[static_cast<std::size_t>(i)], *camera.lens.ray({i - 200.5, y - 0.5})));
  }
  CHECK(worst_rad < LensTable::kTolerance_px * kPi / 360);
}

TEST_CASE("a calibration that states an equirectangular image needs its size alone") {
  const Lens expected = equirectangular_camera(kSphere_px).lens;
  const std::string named = "distortion_model: equirectangular\n";
  for (const std::string& text :
       {named + "image_width: 720\nimage_height: 360\n", named + "image_size: [1440, 720]\n", named}) {
    const Result<Camera> camera = read_sphere(text, kSphere_px);
    REQUIRE(camera.has_value());
    CHECK(camera->lens.parameters() == expected.parameters());
    CHECK(camera->size_px == kSphere_px);
    CHECK(camera->warnings.empty());
  }
  const Result<Camera> ros = read_sphere(
      "image_width: 720\nimage_height: 360\ndistortion_model: equirectangular\ncamera_matrix: {rows: 3, cols: 3, "
      "data: [100, 0, 360, 0, 100, 180, 0, 0, 1]}\ndistortion_coefficients: {rows: 1, cols: 0, data: []}\n");
  REQUIRE(ros.has_value());
  CHECK(ros->lens.parameters() == expected.parameters());
  REQUIRE(ros->warnings.size() == 1);
  CHECK(ros->warnings.front().text().find("camera_matrix") != std::string::npos);
}

TEST_CASE("the project's lens model goes before the file's, and another shape is refused") {
  const Result<Camera> asked = read_sphere("camera_matrix: [0, 0, 0, 0, 0, 0, 0, 0, 0]\nimage_size: [720, 360]\n", {},
                                           LensModel::equirectangular);
  REQUIRE(asked.has_value());
  CHECK(asked->lens.parameters().model == LensModel::equirectangular);
  CHECK(asked->warnings.empty());
  CHECK_FALSE(read_sphere("distortion_model: equirectangular\nimage_size: [720, 360]\n", cv::Size(640, 480)));
  CHECK_FALSE(read_sphere("distortion_model: equirectangular\n"));
  const Result<Camera> high = read_sphere("distortion_model: spherical\n", cv::Size(640, 480));
  REQUIRE(high.has_value());
  REQUIRE(high->warnings.size() == 1);
  CHECK(high->warnings.front().text().find("640x480") != std::string::npos);
}

}  // namespace sigs::test
