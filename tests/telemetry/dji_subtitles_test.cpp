// SPDX-License-Identifier: MIT
#include "telemetry/log_formats.h"

#include <doctest/doctest.h>

#include <fstream>
#include <iterator>

#include "base/pose.h"
#include "broken_bytes.h"
#include "support/test_data.h"
#include "telemetry/track.h"

using namespace sigs;
using namespace sigs::test;

namespace {

std::filesystem::path dji_file(const std::string& name) {
  return real_data() / "telemetry" / "dji-srt" / name;
}

Track dji_track(const std::string& name) {
  const Result<Track> track = read_track(dji_file(name));
  REQUIRE_MESSAGE(track, name << ": " << (track ? "" : track.error().text()));
  CHECK(track->format == "DJI subtitles");
  CHECK(track->on_footage_time);
  CHECK(!track->utc_at_zero_s);  // dates are local time
  CHECK(is_in_order(*track));
  return *track;
}

// What a person reads in the file: the number of places, the first place, the first exposure, aperture and sensitivity.
struct DjiExpected {
  const char* file;
  std::size_t places;
  GeodeticPosition first;
  double first_exposure_s;
  double f_number;
  double iso;
};

}  // namespace

TEST_CASE("each dialect of DJI's subtitles gives the place and exposure that one reads in the file") {
  if (!has_real_data()) return;
  const std::vector<DjiExpected> all = {
      {"air2s.srt", 17, {41.424724, 2.234156, 117}, 1 / 80.0, 2.8, 100},
      {"embedder_Avata360.SRT", 5, {53.365080, 6.460739, -124.744}, 1 / 6400.0, 1.9, 200},
      {"embedder_air3.SRT", 2, {59.1111, 18.2222, 105}, 1 / 1000.0, 2.8, 100},
      {"matrice_300.srt", 381, {36.6146, -6.1120, 0.3}, 0, 0, 0},
      {"mavic_2_style.SRT", 468, {-20.2533, 149.0251, 0}, 1 / 60.0, 2.2, 100},
      {"mavic_mini.SRT", 117, {48.0771, -121.7458, 200.70}, 1 / 30.15, 2.8, 260},
      {"mavic_pro.SRT", 468, {-20.2533, 149.0251, 1.9}, 1 / 60.0, 2.2, 100},
      {"old_format.SRT", 468, {-20.2533, 149.0251, 1.9}, 1 / 60.0, 2.8, 100},
      {"p4_rtk.SRT", 55, {-34.237922, -58.851745, 85.80}, 1 / 400.0, 5.6, 100},
  };
  for (const DjiExpected& expected : all) {
    CAPTURE(expected.file);
    const Track track = dji_track(expected.file);
    CHECK(!track.damaged);
    CHECK(track.position.values.size() == expected.places);
    CHECK(track.position.values.front() == expected.first);
    CHECK(track.exposure_s.empty() == (expected.first_exposure_s == 0));
    if (expected.first_exposure_s > 0)
      CHECK(track.exposure_s.values.front() == doctest::Approx(expected.first_exposure_s).epsilon(1e-14));
    CHECK(track.white_cdpm2.empty() == (expected.iso == 0));
    // ISO 12232 by saturation: an exposure of 78 / S lux seconds is white; of a luminance L the sensor gets 0.65 L t /
    // N^2.
    if (expected.iso > 0)
      CHECK(track.white_cdpm2.values.front() ==
            doctest::Approx(78 / expected.iso * expected.f_number * expected.f_number /
                            (0.65 * expected.first_exposure_s)));
  }
}

TEST_CASE("times are those of the subtitles, and without them those of the dates") {
  if (!has_real_data()) return;
  const Track pro = dji_track("mavic_pro.SRT");
  CHECK(pro.position.times_s.front() == 1);
  CHECK(pro.position.times_s.back() == 468);
  // 2017-08-05 14:11:51, counted as if it were UTC: 17383 days since 1970 by the calendar.
  CHECK(pro.position.own_times_s.front() == 17383 * 86400.0 + 14 * 3600 + 11 * 60 + 51);
  const Track second = dji_track("mavic_2_style.SRT");
  CHECK(second.position.times_s.front() == 0);
  CHECK(second.position.times_s[1] == doctest::Approx(1).epsilon(1e-9));
  CHECK(second.position.times_s.back() == doctest::Approx(468).epsilon(1e-6));  // 14:11:51 to 14:19:39
  CHECK(warnings_with(second, "no times of the footage") == 1);
  CHECK(dji_track("air2s.srt").position.times_s[2] == doctest::Approx(0.066));
}

TEST_CASE("steps of 11 m, one place a second and local time are warned of") {
  if (!has_real_data()) return;
  const Track track = dji_track("matrice_300.srt");
  CHECK(warnings_with(track, "steps of 11.1 m") == 1);
  CHECK(warnings_with(track, "one place in 1 s") == 1);
  CHECK(warnings_with(track, "local time") == 1);
  CHECK(warnings_with(track, "above the place of the start") == 1);
  CHECK(warnings_with(track, "GPS(latitude, longitude") == 1);
  CHECK(warnings_with(dji_track("p4_rtk.SRT"), "steps of") == 0);
}

TEST_CASE("a Phantom 4 RTK that flies to its left leans to its left") {
  if (!has_real_data()) return;
  const Track track = dji_track("p4_rtk.SRT");
  REQUIRE(track.ned_from_airframe.values.size() == 55);
  REQUIRE(track.ned_from_camera.values.size() == 55);
  // Over the 55 s it flies 619 m north and 234 m east: a course of 21 degrees, with its nose at 110.
  const GeodeticPosition from = track.position.values.front();
  const GeodeticPosition to = track.position.values.back();
  const double course_deg = deg_of_rad(std::atan2((to.longitude_deg - from.longitude_deg) * std::cos(rad_of_deg(34.2)),
                                                  to.latitude_deg - from.latitude_deg));
  const Attitude attitude = attitude_of(track.ned_from_airframe.values[10]);
  CHECK(std::abs(deg_of_rad(attitude.yaw_rad) - course_deg - 90) < 5);
  CHECK(deg_of_rad(attitude.roll_rad) < -15);
  CHECK(std::abs(deg_of_rad(attitude.pitch_rad)) < 10);
  const Attitude gimbal = attitude_of(track.ned_from_camera.values.front());
  CHECK(deg_of_rad(gimbal.pitch_rad) == doctest::Approx(-24.4));
  CHECK(deg_of_rad(gimbal.yaw_rad) == doctest::Approx(110.4));
  const Attitude avata = attitude_of(dji_track("embedder_Avata360.SRT").ned_from_camera.values.front());
  CHECK(deg_of_rad(avata.yaw_rad) == doctest::Approx(-162.8));
}

TEST_CASE("subtitles without GPS give exposures, broken ones what stands before the damage or a reason") {
  if (!has_real_data()) return;
  const Track air = dji_track("mavic_air.SRT");
  CHECK(air.position.empty());
  CHECK(air.exposure_s.values.size() == 2);
  CHECK(warnings_with(air, "no place") == 1);
  const Track incomplete = dji_track("broken_incomplete.SRT");
  CHECK(incomplete.damaged);
  CHECK(incomplete.position.values.size() == 19);
  CHECK(warnings_with(incomplete, "line 117: the last subtitle is incomplete") == 1);
  const Result<Track> empty = read_track(dji_file("broken_empty2.SRT"));
  REQUIRE(!empty);
  CHECK(empty.error().what.find("no subtitle") != std::string::npos);
}

TEST_CASE("places that cannot be are left out, with the order in which they were read") {
  const auto cue = [](int n, const std::string& text) {
    return std::to_string(n) + "\n00:00:0" + std::to_string(n) + ",000 --> 00:00:09,000\n" + text + "\n\n";
  };
  const Result<Track> track =
      dji_subtitles_track(cue(1, "GPS(8.5,47.3,12) BAROMETER:5.0") + cue(2, "GPS(47.3,108.5,12) BAROMETER:5.0") +
                              cue(3, "GPS(0.0000,0.0000,0) BAROMETER:5.0") + cue(4, "GPS(n/a,n/a,0) BAROMETER:5.0"),
                          "made.srt");
  REQUIRE(track);
  CHECK(track->position.values.size() == 1);
  CHECK(track->position.values[0].latitude_deg == 47.3);
  CHECK(warnings_with(*track, "latitude beyond 90 degrees is impossible; read as GPS(longitude, latitude") == 1);
  CHECK(warnings_with(*track, "without a fix") == 1);
  CHECK(warnings_with(*track, "not a number") == 1);
  CHECK(!dji_subtitles_track(cue(1, "Good morning.") + cue(2, "Good night, 2020."), "talk.srt"));
}

TEST_CASE("broken subtitles are read or refused, never beyond their end") {
  if (!has_real_data()) return;
  for (const char* const name : {"p4_rtk.SRT", "embedder_Avata360.SRT", "mavic_2_style.SRT", "matrice_300.srt"}) {
    std::ifstream in(dji_file(name), std::ios::binary);
    const std::string text = std::string{std::istreambuf_iterator<char>(in), {}}.substr(0, 6000);
    const auto read = [](std::string_view broken) { return dji_subtitles_track(broken, "broken.srt"); };
    CHECK(survives(text, read, 200, 200, text.size()));
  }
}
