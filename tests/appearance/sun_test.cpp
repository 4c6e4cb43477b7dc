// SPDX-License-Identifier: MIT
#include "appearance/sun.h"

#include <doctest/doctest.h>

#include "appearance/surroundings.h"
#include "made_scene.h"
#include "support/test_data.h"
#include "video/frame_source.h"

using namespace sigs;
using namespace sigs::test;

namespace {

SunEstimate sun_of(const LightOfRay& light, const Attitude& attitude, const View& extra = {},
                   const std::optional<GivenSun>& given = std::nullopt) {
  const Camera camera = wide_camera({960, 720});
  View view = extra;
  view.camera = &camera;
  view.world_from_camera = rotation_of(attitude);
  Surroundings surroundings;
  surroundings.add(frame_of(seen(camera, rotation_of(attitude), light)), view);
  return surroundings.finish(given).sun;
}

double off_deg(double a_rad, double b_rad) {
  return deg_of_rad(std::abs(std::remainder(a_rad - b_rad, 2 * std::numbers::pi)));
}

// A clear sky after ISO 15469, type 12: gradation a = -1, b = -0.32 and the indicatrix, scaled to 0.2 at 45 degrees.
glm::dvec3 clear_sky(const glm::dvec3& ray, double azimuth_rad, double elevation_rad) {
  if (ray.z > -0.01) return {0.1, 0.1, 0.08};
  const double chi = angle_between(ray, to_sun_of(azimuth_rad, elevation_rad));
  const double indicatrix =
      1 + 10 * (std::exp(-3 * chi) - std::exp(-3 * std::numbers::pi / 2)) + 0.45 * std::cos(chi) * std::cos(chi);
  const double gradation = 1 - std::exp(-0.32 / -ray.z);
  return 0.2 * indicatrix * gradation * glm::dvec3(0.4, 0.9, 2.2) / 1.6;
}

}  // namespace

TEST_CASE("the sun's azimuth follows from shadows on the ground within 10 degrees") {
  for (const double azimuth_deg : {-150.0, -80.0, 30.0, 110.0, 170.0}) {
    const SunEstimate sun =
        sun_of(Posts{.azimuth_rad = rad_of_deg(azimuth_deg)}, {.roll_rad = 0.1, .pitch_rad = -0.55, .yaw_rad = 0.4});
    CAPTURE(azimuth_deg);
    REQUIRE(sun.evidence == SunEvidence::shadows);
    CHECK(off_deg(sun.azimuth_rad.value, rad_of_deg(azimuth_deg)) < 10);
    CHECK(off_deg(sun.azimuth_rad.value, rad_of_deg(azimuth_deg)) < 3 * deg_of_rad(sun.azimuth_rad.sd));
    CHECK_FALSE(sun.elevation_rad.is_known);  // nothing says how high the posts are
  }
}

TEST_CASE("ground without shadows does not show the sun") {
  const SunEstimate sun = sun_of(Posts{.has_shadows = false}, {.pitch_rad = -0.55});
  CHECK_FALSE(sun.azimuth_rad.is_known);
  CHECK_FALSE(sun.azimuth_rad.why.empty());
}

TEST_CASE("a clear sky shows a sun ahead within 10 degrees") {
  for (const double azimuth_deg : {25.0, -40.0, 60.0}) {
    const double azimuth = rad_of_deg(azimuth_deg), elevation = rad_of_deg(35);
    const SunEstimate sun =
        sun_of([&](const glm::dvec3& ray) { return clear_sky(ray, azimuth, elevation); }, {.pitch_rad = 0.35});
    CAPTURE(azimuth_deg);
    REQUIRE(sun.evidence == SunEvidence::sky);
    CHECK(off_deg(sun.azimuth_rad.value, azimuth) < 10);
    REQUIRE(sun.elevation_rad.is_known);
    CHECK(off_deg(sun.elevation_rad.value, elevation) < 10);
  }
}

TEST_CASE("the brightness around the sun is that of the standard, and falls with the angle") {
  CHECK(clear_sky_indicatrix(std::numbers::pi / 2) == doctest::Approx(1));
  CHECK(clear_sky_indicatrix(0) == doctest::Approx(1 + 10 * (1 - 0.00898329) + 0.45));
  for (double angle = 0; angle < 1.5; angle += 0.1)
    CHECK(clear_sky_indicatrix(angle) > clear_sky_indicatrix(angle + 0.1));
}

TEST_CASE("too few samples, an even sky and a lens' dark corners are no sun") {
  CHECK_FALSE(sun_of_sky({}));
  std::vector<SkySample> even, corners;
  for (int band = 0; band < 4; ++band)
    for (int i = 0; i < 10; ++i) {
      const double azimuth = 0.1 * (i - 4.5), elevation = 0.2 + 0.1 * band, from_axis = std::hypot(azimuth, elevation);
      even.push_back({azimuth, elevation, 0.3, from_axis, band});
      corners.push_back({azimuth, elevation, 0.3 * (1 - 0.5 * from_axis * from_axis), from_axis, band});
    }
  CHECK_FALSE(sun_of_sky(even));
  CHECK_FALSE(sun_of_sky(corners));
}

TEST_CASE("a direction by time and place stands before what the image shows") {
  const GivenSun given{.to_sun_in_world = to_sun_of(1.2, 0.8)};
  const SunEstimate sun = sun_of(Posts{.azimuth_rad = -1}, {.pitch_rad = -0.55}, {}, given);
  CHECK(sun.evidence == SunEvidence::given);
  CHECK(sun.azimuth_rad.value == doctest::Approx(1.2));
  CHECK(sun.elevation_rad.value == doctest::Approx(0.8));
  LightSettings settings;
  apply(sun, settings);
  CHECK_FALSE(settings.sun.azimuth_deg);  // time and place go on to tell it
  apply(Sun().finish(), settings);
  CHECK(settings.sun.azimuth_deg.value() == doctest::Approx(165).epsilon(0.001));
  CHECK(settings.sun.elevation_deg.value() == doctest::Approx(25).epsilon(0.02));
  const SunEstimate nowhere = Sun().finish(GivenSun{});
  CHECK(nowhere.evidence == SunEvidence::none);
}

TEST_CASE("blank, black, over-exposed and gray images and none at all do not show the sun") {
  for (const int level : {0, 110, 255})
    for (const PixelLayout layout : {PixelLayout::yuv420, PixelLayout::gray}) {
      const Camera camera = wide_camera();
      Surroundings surroundings;
      surroundings.add(frame_of(cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(level)), layout),
                       {.camera = &camera, .world_from_camera = rotation_of({.pitch_rad = -0.2})});
      const SunEstimate sun = surroundings.finish().sun;
      CHECK_FALSE(sun.azimuth_rad.is_known);
      CHECK_FALSE(sun.elevation_rad.is_known);
      CHECK(std::isfinite(sun.azimuth_rad.value));
    }
  CHECK_FALSE(Sun().finish().azimuth_rad.is_known);
  Surroundings nothing;
  nothing.add(Frame{});
  CHECK_FALSE(nothing.finish().sun.azimuth_rad.is_known);
}

TEST_CASE("of footage without a calibration the sun is not known") {
  Surroundings surroundings;
  surroundings.add(frame_of(seen(wide_camera(), rotation_of({}), HazyPlain{})));
  const SunEstimate sun = surroundings.finish().sun;
  CHECK_FALSE(sun.azimuth_rad.is_known);
  CHECK(sun.azimuth_rad.why.find("calibration") != std::string::npos);
}

TEST_CASE("in the sample footage, whose shadows lie behind their trees, nothing false is said") {
  const std::filesystem::path assets = source_dir() / "assets";
  const auto camera = read_calibration(assets / "calibrations" / "sample.xml");
  REQUIRE(camera);
  for (const char* name : {"sample.mp4", "table1_clear.mp4"}) {
    auto footage = FrameSource::open(assets / "footage" / name);
    REQUIRE(footage);
    Surroundings surroundings;
    for (int n = 0; n < footage->info().frame_count(); n += 60)
      surroundings.add(footage->read(n).value(), {.camera = &*camera, .world_from_camera = glm::dquat(1, 0, 0, 0)});
    const SunEstimate sun = surroundings.finish().sun;
    const double truth_rad = std::atan2(1000, -2000);
    CHECK(
        (!sun.azimuth_rad.is_known || off_deg(sun.azimuth_rad.value, truth_rad) < 2 * deg_of_rad(sun.azimuth_rad.sd)));
  }
}
