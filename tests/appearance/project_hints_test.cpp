// SPDX-License-Identifier: MIT
#include "appearance/appearance.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "base/pose.h"
#include "support/test_data.h"
#include "video/video_writer.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// NREL/TP-560-34302 (Reda and Andreas 2008), appendix A.5: 2003-10-17 19:30:30 UTC at Golden, Colorado. The elevation
// is with refraction: 90 degrees less the zenith angle of 50.11162.
constexpr double kUtc_s = 1066419030;
constexpr double kLatitude_deg = 39.742476, kLongitude_deg = -105.1786;
constexpr double kAzimuth_deg = 194.340241, kElevation_deg = 39.88838;
constexpr double kHeading_deg = 200;

// A project with a clip of gray frames, one a second, and a log.
class LoggedFlight {
 public:
  //   log_head  lines before the columns
  //   log_early_s  by how much the log begins before the footage
  LoggedFlight(const std::string& log_head, double log_early_s, int frames = 8) {
    const std::filesystem::path log = folder_ / "flight.csv";
    write_clip(frames);
    std::ofstream out(log);
    out << log_head << "time_s,latitude_deg,longitude_deg,height_m,roll_deg,pitch_deg,yaw_deg\n";
    out.precision(12);
    for (int i = 0; i <= frames + log_early_s + 1; ++i)
      out << i << "," << kLatitude_deg << "," << kLongitude_deg << ",1830.14,0,0," << kHeading_deg << "\n";
    project_.footage.video = (folder_ / "clip.mkv").string();
    project_.camera.track = {.file = log.string(), .offset_s = log_early_s, .attitude = TrackAttitudeChoice::airframe};
  }

  [[nodiscard]] Project& project() { return project_; }

  [[nodiscard]] Appearance found() const {
    Result<FrameSource> footage = FrameSource::open(project_.footage.video);
    REQUIRE(footage);
    const Result<AppearanceHints> hints = hints_of(project_, footage->info(), false, [](const Warning&) {});
    if (!hints) FAIL(hints.error().text());
    Result<Appearance> found = estimate_appearance(*footage, {}, *hints, {});
    REQUIRE(found);
    return *found;
  }

 private:
  void write_clip(int frames) {
    const VideoFormat format{.size_px = {64, 48}, .layout = PixelLayout::gray};
    Result<VideoWriter> writer = VideoWriter::open(folder_ / "clip.mkv", format);
    REQUIRE(writer);
    for (int n = 0; n < frames; ++n) {
      Frame frame{.layout = PixelLayout::gray, .planes = {cv::Mat(format.size_px, CV_8UC1, cv::Scalar(120))}};
      frame.time_s = n;
      REQUIRE(writer->write(frame, n));
    }
    REQUIRE(writer->finish());
  }

  TemporaryFolder folder_;
  Project project_;
};

const AppearanceQuantity& quantity_of(const std::vector<AppearanceQuantity>& all, const std::string& name) {
  for (const AppearanceQuantity& one : all)
    if (one.name == name) return one;
  FAIL("there is no ", name);
  return all.front();
}

std::string utc_line(double utc_s) {
  return "# utc_at_zero_s: " + std::to_string(utc_s) + "\n";
}

}  // namespace

TEST_CASE("a log with time and place tells where the sun stands, against the camera's heading at the start") {
  // The middle frame used of eight, one a second, is 4 s after the first; the log begins 30 s before.
  LoggedFlight flight(utc_line(kUtc_s - 4 - 30), 30);
  flight.project().light.sun = {.azimuth_deg = 77, .elevation_deg = 5};  // what the project had is not what is found
  const Appearance found = flight.found();
  const std::vector<AppearanceQuantity> quantities = quantities_of(found);
  const AppearanceQuantity& azimuth = quantity_of(quantities, "sun's azimuth");
  const AppearanceQuantity& elevation = quantity_of(quantities, "sun's elevation");
  REQUIRE(azimuth.estimate.is_known);
  REQUIRE(elevation.estimate.is_known);
  CHECK(std::abs(azimuth.estimate.value - (kAzimuth_deg - kHeading_deg)) < 0.02);  // the sun moves 0.005 a second
  CHECK(std::abs(elevation.estimate.value - kElevation_deg) < 0.01);
  for (const AppearanceQuantity* one : {&azimuth, &elevation}) {
    CHECK(one->estimate.sd >= 1);
    CHECK(one->estimate.sd < 1.01);  // the sun hardly moves in these seconds
    CHECK(one->how == "by time and place");
    CHECK(text_of(*one).ends_with("deg, by time and place"));
  }
}

TEST_CASE("a direction by time and place is left to the project, frame by frame") {
  const Appearance found = LoggedFlight(utc_line(kUtc_s), 0).found();
  CHECK(found.surroundings.sun.evidence == SunEvidence::given);
  Appearance with_sky = found;  // as where the light is known
  for (Estimate& part : with_sky.surroundings.light.sky_color) part = {.value = 0.3, .sd = 0.1, .is_known = true};
  Project project;
  project.light.sun = {.azimuth_deg = 77, .elevation_deg = 5};
  apply(with_sky, project);
  CHECK_FALSE(project.light.sun.azimuth_deg);
  CHECK_FALSE(project.light.sun.elevation_deg);
}

TEST_CASE("to a thermal project the footage's light and haze mean nothing, and a blur that is not seen stays") {
  Appearance found = LoggedFlight(utc_line(kUtc_s), 0).found();
  for (Estimate& part : found.surroundings.light.sky_color) part = {.value = 0.3, .sd = 0.1, .is_known = true};
  found.surroundings.tone.black = {.value = 0.1, .sd = 0.01, .is_known = true};
  Project project;
  project.footage.spectrum = Spectrum::thermal;
  project.appearance.psf_sigma_px = 0.35;
  project.appearance.sharpening = -0.4;
  const Project before = project;
  found.point_spread.sigma_px = {.value = 0.9, .sd = 0.1, .is_known = false};
  apply(found, project);
  CHECK(project.light == before.light);
  CHECK(project.appearance.black == 0);
  CHECK(project.appearance.psf_sigma_px == 0.35);
  CHECK(project.appearance.sharpening == -0.4);
  found.point_spread.sigma_px.is_known = true;
  apply(found, project);
  CHECK(project.appearance.psf_sigma_px == 0.9);
  CHECK(project.light == before.light);
  // The sky's code, where it was looked for and seen.
  project.appearance.thermal.sky = 70;
  apply(found, project);
  CHECK(project.appearance.thermal.sky == 70);
  found.levels = LevelsEstimate{.sky = {.value = 96, .why = "most frames show no sky"},
                                .ground = {},
                                .halo = {.value = 0.9, .why = "no warm skyline"},
                                .halo_px = {.value = 25, .sd = 3, .is_known = true}};
  project.appearance.thermal.halo = 0.3;
  found.noise.sd_dark = {.value = 1, .sd = 0.1, .is_known = true};
  found.noise.sd_bright = {.value = 6, .sd = 1, .is_known = true};
  apply(found, project);
  // The variance at the sky's code, 1 + 70 / 255 * 35, at both ends.
  CHECK(project.appearance.grain.sd_dark == doctest::Approx(std::sqrt(1 + 70 / 255.0 * 35)).epsilon(1e-3));
  CHECK(project.appearance.grain.sd_bright == project.appearance.grain.sd_dark);
  CHECK(project.appearance.thermal.sky == 70);
  CHECK(project.appearance.thermal.halo == 0.3);
  CHECK(project.appearance.thermal.halo_px == 25);
  found.levels->sky = {.value = 51, .sd = 1, .is_known = true};
  apply(found, project);
  CHECK(project.appearance.thermal.sky == 51);
  const std::vector<std::string> applied = applied_settings(found);
  CHECK(std::ranges::find(applied, "appearance.thermal.sky") != applied.end());
  found.levels.reset();
  project.footage.spectrum = Spectrum::visible;
  apply(found, project);
  CHECK(project.appearance.black == 0.1);
  CHECK(project.appearance.thermal.sky == 51);
}

TEST_CASE("while the footage is taken the sun moves, which its deviation has") {
  const SunEstimate sun = Sun().finish(
      GivenSun{.to_sun_in_world = {1, 0, -1}, .azimuth_range_rad = rad_of_deg(60), .elevation_range_rad = 0});
  CHECK(deg_of_rad(sun.azimuth_rad.sd) == doctest::Approx(std::hypot(1, 60 / std::sqrt(12))));  // even over 60 degrees
  CHECK(deg_of_rad(sun.elevation_rad.sd) == doctest::Approx(1));
}

TEST_CASE("a log without UTC does not tell the sun") {
  const Appearance found = LoggedFlight("", 0).found();
  CHECK(found.surroundings.sun.evidence == SunEvidence::none);
  const std::vector<AppearanceQuantity> quantities = quantities_of(found);
  const AppearanceQuantity& azimuth = quantity_of(quantities, "sun's azimuth");
  CHECK_FALSE(azimuth.estimate.is_known);
  CHECK_FALSE(azimuth.estimate.why.empty());
  CHECK(azimuth.how.empty());
  CHECK(text_of(azimuth).find("is taken") != std::string::npos);
  CHECK_FALSE(quantity_of(quantities, "sun's elevation").estimate.is_known);
}
