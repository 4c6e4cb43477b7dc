// SPDX-License-Identifier: MIT
#include "autocalibration/division_lens.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace sigs {
namespace {

constexpr double kQuarter_rad = std::numbers::pi / 4;

DivisionLens lens_with(double distortion) {
  return {.size_px = {1280, 720}, .focal_px = 800, .distortion = distortion};
}

}  // namespace

TEST_CASE("a division lens takes a pixel to a direction and back to the same pixel") {
  for (const double distortion : {-0.6, -0.2, 0.0, 0.15})
    for (const glm::dvec2& pixel : {glm::dvec2(0, 0), glm::dvec2(639.5, 359.5), glm::dvec2(1279, 3)}) {
      const DivisionLens lens = lens_with(distortion);
      const auto back = lens.pixel(3.7 * lens.ray(pixel));
      REQUIRE(back);
      CHECK(glm::length(*back - pixel) < 1e-9);
    }
}

TEST_CASE("without distortion a division lens is a pinhole, at -(radius / 2 focal)^2 a stereographic fisheye") {
  const double angle_rad = 0.4;
  const glm::dvec3 aside(std::cos(angle_rad), std::sin(angle_rad), 0);
  CHECK((*lens_with(0).pixel(aside)).x == doctest::Approx(639.5 + 800 * std::tan(angle_rad)));
  DivisionLens fisheye = lens_with(0);
  fisheye.distortion = -std::pow(fisheye.radius_px() / (2 * fisheye.focal_px), 2);
  CHECK((*fisheye.pixel(aside)).x == doctest::Approx(639.5 + 1600 * std::tan(angle_rad / 2)));
  // 90 degrees from the axis and beyond: a pinhole has no image of them.
  CHECK_FALSE(lens_with(0).pixel({-0.1, 1, 0}));
  CHECK((*fisheye.pixel({0, 1, 0})).x == doctest::Approx(639.5 + 1600 * std::tan(kQuarter_rad)));
}

TEST_CASE("a field of view of 90 degrees has the focal length of half of the width") {
  const auto lens = division_lens_of_field({1280, 720}, 2 * kQuarter_rad, 0);
  REQUIRE(lens);
  CHECK(lens->focal_px == doctest::Approx(640));
  for (const double distortion : {-0.3, 0.1}) {
    const auto wide = division_lens_of_field({1280, 720}, 1.9, distortion);
    REQUIRE(wide);
    CHECK(wide->horizontal_field_rad() == doctest::Approx(1.9));
  }
  CHECK_FALSE(division_lens_of_field({1280, 720}, 0, 0));
  CHECK_FALSE(division_lens_of_field({1280, 720}, 3.2, 0));
  CHECK_FALSE(division_lens_of_field({0, 0}, 1, 0));
}

TEST_CASE("OpenCV's models of a division lens show the same directions at the same pixels") {
  for (const double distortion : {-0.5, -0.25, -0.1, 0.0, 0.1}) {
    CAPTURE(distortion);
    const DivisionLens lens = lens_with(distortion);
    const Result<LensParameters> parameters = parameters_of(lens);
    REQUIRE(parameters);
    const Result<Lens> model = Lens::make(*parameters);
    REQUIRE(model);
    for (double x = -0.5; x < 1280; x += 80)
      for (double y = -0.5; y < 720; y += 60) {
        const auto pixel = model->pixel(lens.ray({x, y}));
        REQUIRE(pixel);
        // A polynomial of four terms does not follow it more closely; the lens is not known better.
        CHECK(std::hypot(pixel->x - x, pixel->y - y) < 2);
      }
  }
  CHECK(parameters_of(lens_with(0))->coefficients.empty());
}

TEST_CASE("the focal length that DJI's subtitles state is read, in millimetres and in tenths") {
  CHECK(dji_focal_mm("[iso : 100] [focal_len : 240] [ct : 5500]") == doctest::Approx(24));
  CHECK(dji_focal_mm("[focal_len: 28.00]") == doctest::Approx(28));
  CHECK(dji_focal_mm("[focal_len: 166.00]") == doctest::Approx(166));
  for (const char* const text : {"", "focal_len", "focal_len :", "focal_len: x", "focal_len: 0", "focal_len: 1e9",
                                 "focal_len: -24", "focal_len: 99999999999999999999999"})
    CHECK_FALSE(dji_focal_mm(text));
}

TEST_CASE("a GoPro's diagonal field of view is read, however deep it lies, and broken payloads state none") {
  using namespace std::string_literals;
  const auto element = [](const std::string& key, char type, char size, char repeat, const std::string& value) {
    return key + std::string{type, size, '\0', repeat} + value;
  };
  // 122.5 as a float of 4 bytes, big endian.
  const std::string field = element("ZFOV", 'f', 4, 1, "\x42\xF5\0\0"s);
  const std::string stream = element("STRM", '\0', 1, 12, field);
  const std::string payload = element("DEVC", '\0', 1, 20, stream);
  const auto found = gopro_diagonal_field_rad(payload);
  REQUIRE(found);
  CHECK(*found == doctest::Approx(122.5 * std::numbers::pi / 180));
  for (std::size_t cut = 0; cut < payload.size(); ++cut)
    CHECK_FALSE(gopro_diagonal_field_rad(std::string_view(payload).substr(0, cut)));
  CHECK_FALSE(gopro_diagonal_field_rad(element("ZFOV", 'f', 4, 1, "\x7F\xC0\0\0"s)));  // not a number
}

}  // namespace sigs
