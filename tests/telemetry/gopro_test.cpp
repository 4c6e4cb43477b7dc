// SPDX-License-Identifier: MIT
// GoPro payloads that were made here, so that every sample is known.
#include "telemetry/log_formats.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "base/pose.h"
#include "gpmf_writer.h"
#include "telemetry/track_report.h"

using namespace sigs;
using namespace sigs::test;
namespace {

DataPackets packets_of(const std::vector<std::string>& payloads) {
  DataPackets packets;
  for (const std::string& payload : payloads)
    packets.packets.push_back({.bytes = payload,
                               .time_s = static_cast<double>(packets.packets.size()),
                               .duration_s = 1,
                               .file_offset = 1000 * static_cast<std::int64_t>(packets.packets.size())});
  return packets;
}

std::string camera_with(const std::string& streams, const std::string& model = "HERO9 Black") {
  return gpmf_nest("DEVC", gpmf_u32("DVID", 1) + gpmf_string("DVNM", model) + streams);
}

bool says(const Track& track, const std::string& words) {
  for (const Warning& warning : track.warnings)
    if (warning.text().find(words) != std::string::npos) return true;
  return false;
}

Result<Track> read_payloads(const std::vector<std::string>& payloads) {
  return track_of_gopro("clip.mp4", packets_of(payloads));
}

// One payload with everything that the reader knows.
std::string full_payload(std::uint32_t index) {
  const std::string gyro = gpmf_nest("STRM", gpmf_u32("TSMP", 4 * (index + 1)) + gpmf_string("STNM", "Gyroscope") +
                                                 gpmf_string("ORIN", "ZXY") + gpmf_shorts("SCAL", 1, {100}) +
                                                 gpmf_shorts("GYRO", 3, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
  const std::string turns =
      gpmf_nest("STRM", gpmf_shorts("SCAL", 1, {32767}) + gpmf_shorts("CORI", 4, {32767, 0, 0, 0, 32767, 0, 0, 0}));
  const std::string shutter = gpmf_nest("STRM", gpmf_floats("SHUT", 1, {0.01F, 0.02F}));
  const std::string gps =
      gpmf_nest("STRM", gpmf_ints("GPSF", 1, {3}) + gpmf("GPSU", 'U', 16, 1, "220304050607.500") +
                            gpmf_string("GPSA", "MSLV") + gpmf_ints("SCAL", 1, {10000000, 10000000, 1000, 1000, 100}) +
                            gpmf_ints("GPS5", 5, {473000000, 85000000, 400000, 0, 0}));
  const std::string unknown =
      gpmf_nest("STRM", gpmf_shorts("WNDM", 2, {1, 2})) + gpmf_nest("STRM", gpmf_nest("FACE", gpmf_u32("TICK", 1)));
  return camera_with(gyro + turns + shutter + gps + unknown);
}

}  // namespace

TEST_CASE("what a payload states is scaled, named and put on the axes of the camera") {
  const Result<Track> track = read_payloads({full_payload(0), full_payload(1), full_payload(2), full_payload(3)});
  REQUIRE(track);
  CHECK_FALSE(track->damaged);
  CHECK(track->device == "HERO9 Black");
  REQUIRE(track->camera_rate_radps.values.size() == 16);
  // Columns are up, left, backwards, in hundredths.
  CHECK(glm::distance(track->camera_rate_radps.values[0], glm::dvec3(-0.03, -0.02, -0.01)) < 1e-12);
  // Four samples a second, evenly.
  for (std::size_t i = 0; i < 16; ++i)
    CHECK(std::abs(track->camera_rate_radps.times_s[i] - 0.25 * static_cast<double>(i)) < 1e-9);
  CHECK(track->exposure_s.values[1] == doctest::Approx(0.02));
  REQUIRE(track->position.values.size() == 4);
  CHECK(track->position.values[0] == GeodeticPosition{47.3, 8.5, 400});
  // 2022-03-04 05:06:07.5 UTC is 1646370367.5 s; the same text in each of the payloads 0 to 3 s: their median.
  REQUIRE(track->utc_at_zero_s);
  CHECK(std::abs(*track->utc_at_zero_s - (1646370367.5 - 1)) <= 1);
  CHECK_FALSE(says(*track, "WNDM"));  // it is there and nothing is made of it: no warning, but a line of the report
  CHECK(std::find(track->unused_streams.begin(), track->unused_streams.end(), "WNDM") != track->unused_streams.end());
  CHECK(track_report_text(*track).find("streams not used: ") != std::string::npos);
}

TEST_CASE("each way of naming the axes gives the same rotation about the camera's axes") {
  // The camera turns right (about Z down) at 1 rad/s and pitches up (about Y right) at 0.2 rad/s: about GoPro's axes
  // X left -0.2, Y backwards 0, Z up -1.
  struct Case {
    std::string describing;
    std::vector<int> columns;
    std::string model;
  };
  const std::string no_change = gpmf_floats("MTRX", 9, {0, 0, 1, 0, -1, 0, 1, 0, 0}) + gpmf_string("ORIO", "ZXY");
  for (const Case& sample :
       {Case{gpmf_string("ORIN", "ZXY"), {-100, -20, 0}, "HERO11 Black"},
        Case{gpmf_string("ORIN", "YxZ"), {0, 20, -100}, "HERO8 Black"},
        Case{gpmf_string("ORIN", "zxY"), {100, 20, 0}, "HERO8 Black"}, Case{no_change, {0, 20, -100}, "HERO7 Black"},
        Case{gpmf_string("STNM", "Gyroscope (z,x,y)"), {-100, -20, 0}, "Camera"},
        Case{gpmf_string("STNM", "Gyroscope"), {0, 20, -100}, "Hero6 Black"},
        Case{gpmf_string("STNM", "Gyroscope"), {0, -20, -100}, "Fusion"}, Case{"", {-100, -20, 0}, "Camera"}}) {
    const Result<Track> track = read_payloads({camera_with(
        gpmf_nest("STRM", sample.describing + gpmf_shorts("SCAL", 1, {100}) + gpmf_shorts("GYRO", 3, sample.columns)),
        sample.model)});
    REQUIRE(track);
    REQUIRE(track->camera_rate_radps.values.size() == 1);
    CHECK(glm::distance(track->camera_rate_radps.values[0], glm::dvec3(0, 0.2, 1)) < 1e-6);
    CHECK(says(*track, "assumed") == sample.describing.empty());
  }
}

TEST_CASE("gravity points down whichever sign the camera stores, by its accelerometer") {
  for (const int sign : {1, -1}) {
    const Result<Track> track = read_payloads(
        {camera_with(gpmf_nest("STRM", gpmf_shorts("SCAL", 1, {32767}) + gpmf_shorts("GRAV", 3, {0, sign * 32767, 0})) +
                     gpmf_nest("STRM", gpmf_string("ORIN", "ZXY") + gpmf_shorts("SCAL", 1, {100}) +
                                           gpmf_shorts("ACCL", 3, {981, 0, 0})))});
    REQUIRE(track);
    REQUIRE(track->camera_gravity.values.size() == 1);
    CHECK(glm::distance(track->camera_gravity.values[0], glm::dvec3(0, 0, 1)) < 1e-3);
    CHECK(track->camera_force_mps2.values[0].z == doctest::Approx(-9.81));
  }
}

TEST_CASE("places without a fix and places at 0/0 are left out, and said with their times") {
  const auto gps = [](int fix, int latitude, int longitude) {
    return camera_with(gpmf_nest("STRM", gpmf_ints("GPSF", 1, {fix}) +
                                             gpmf_ints("SCAL", 1, {10000000, 10000000, 1000, 1000, 100}) +
                                             gpmf_ints("GPS5", 5, {latitude, longitude, 0, 0, 0})));
  };
  const Result<Track> track = read_payloads({gps(0, 470000000, 80000000), gps(3, 0, 0), gps(3, 470000000, 80000000)});
  REQUIRE(track);
  REQUIRE(track->position.values.size() == 1);
  CHECK(track->position.times_s[0] == doctest::Approx(2));
  CHECK(says(*track, "without a fix (GPSF) left out, at 0.00 s"));
  CHECK(says(*track, "latitude 0, longitude 0 left out, at 1.00 s"));
}

TEST_CASE("stamps of the camera's clock give times that a late payload does not shift") {
  // 10 samples a second by STMP; payload 2 is 0.4 s late.
  DataPackets packets;
  for (int p = 0; p < 5; ++p) {
    std::vector<int> samples;
    for (int i = 0; i < 10; ++i) samples.insert(samples.end(), {10 * p + i, 0, 0});
    const std::string stamp =
        gpmf("STMP", 'J', 8, 1, big_endian_bytes(7000000 + 1000000 * static_cast<unsigned>(p), 8));
    packets.packets.push_back(
        {.bytes = camera_with(gpmf_nest("STRM", stamp + gpmf_string("ORIN", "ZXY") + gpmf_shorts("GYRO", 3, samples))),
         .time_s = p + (p == 2 ? 0.4 : 0.0),
         .duration_s = 1});
  }
  const Result<Track> track = track_of_gopro("clip.mp4", packets);
  REQUIRE(track);
  REQUIRE(track->camera_rate_radps.values.size() == 50);
  for (std::size_t i = 0; i < 50; ++i) {
    CHECK(track->camera_rate_radps.times_s[i] == doctest::Approx(0.1 * static_cast<double>(i)));
    CHECK(track->camera_rate_radps.own_times_s[i] == doctest::Approx(7 + 0.1 * static_cast<double>(i)));
  }
}

TEST_CASE("payloads cut short at every byte, and with flipped bits, are read without harm") {
  const std::string whole = full_payload(0);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const Result<Track> track = read_payloads({whole, whole.substr(0, length)});
    REQUIRE(track);  // the first payload is sound
    CHECK(track->camera_rate_radps.values.size() >= 4);
    if (length > 0) CHECK(track->damaged);
  }
  std::mt19937 random(1);
  for (int n = 0; n < 3000; ++n) {
    std::string broken = whole;
    for (int flips = 0; flips < 1 + n % 5; ++flips)
      broken[random() % broken.size()] ^= static_cast<char>(1 << random() % 8);
    const Result<Track> track = read_payloads({broken, broken, whole, broken});
    if (!track) continue;
    for (const double time_s : track->camera_rate_radps.times_s) CHECK(std::isfinite(time_s));
    for (const glm::dvec3& rate : track->camera_rate_radps.values) CHECK(std::isfinite(rate.x + rate.y + rate.z));
    for (const GeodeticPosition& place : track->position.values) CHECK(std::abs(place.latitude_deg) <= 90);
  }
}

TEST_CASE("damage is said with its place in the file, and what stands before it is read") {
  const std::string whole = full_payload(0);
  const Result<Track> track = read_payloads({whole, whole.substr(0, whole.size() / 2)});
  REQUIRE(track);
  CHECK(track->damaged);
  CHECK(says(*track, "byte 1000 of the file"));  // the device's length runs beyond the payload, which begins there
  CHECK(track->camera_rate_radps.values.size() == 8);  // the gyroscope comes first, and is whole in both
}

TEST_CASE("telemetry without anything that is known is an error, not an empty track") {
  CHECK_FALSE(read_payloads({}));
  CHECK_FALSE(read_payloads({camera_with(gpmf_nest("STRM", gpmf_shorts("WNDM", 2, {1, 2})))}));
  CHECK_FALSE(read_payloads({std::string(1000, '\x7f')}));
}

TEST_CASE("a scale of zero leaves the samples out") {
  const Result<Track> track =
      read_payloads({camera_with(gpmf_nest("STRM", gpmf_shorts("SCAL", 1, {0}) + gpmf_shorts("GYRO", 3, {1, 2, 3})) +
                                 gpmf_nest("STRM", gpmf_floats("SHUT", 1, {0.01F})))});
  REQUIRE(track);
  CHECK(track->camera_rate_radps.empty());
  CHECK(says(*track, "no number"));
}

namespace {

// An attitude as CORI and IORI store it: w, then the parts about X left, Z up and Y backwards.
void add_turn(std::vector<float>& numbers, const glm::dquat& q) {
  for (const double number : {q.w, -q.y, -q.z, -q.x}) numbers.push_back(static_cast<float>(number));
}

// Ten samples: the camera turns, its stabilisation turns the image, gravity is measured in the camera's axes.
struct StabilisedFlight {
  glm::dquat world_from_start = rotation_of({0.1, -0.3, 0});
  std::vector<float> cori, iori, grav;
  std::vector<glm::dquat> world_from_image;

  explicit StabilisedFlight(double wrong_gravity_rad = 0) {
    for (int i = 0; i < 10; ++i) {
      const glm::dquat camera = rotation_of({0.02 * i, -0.01 * i, 0.05 * i});
      const glm::dquat image = rotation_of({-0.015 * i, 0.01 * std::sin(i), 0.02 * std::cos(i)});
      add_turn(cori, camera);
      add_turn(iori, image);
      const glm::dquat tilted = rotation_of({i % 2 == 0 ? wrong_gravity_rad : -wrong_gravity_rad, 0, 0});
      const glm::dvec3 down = tilted * (glm::conjugate(world_from_start * camera) * glm::dvec3(0, 0, 1));
      for (const double number : {-down.y, down.z, down.x}) grav.push_back(static_cast<float>(number));
      world_from_image.push_back(world_from_start * camera * image);
    }
  }

  [[nodiscard]] Result<Track> read(bool with_iori, bool with_grav) const {
    const auto stream = [](const char* key, int columns, const std::vector<float>& numbers) {
      return gpmf_nest("STRM", gpmf_floats(key, columns, numbers));
    };
    return read_payloads({camera_with(stream("CORI", 4, cori) + (with_iori ? stream("IORI", 4, iori) : "") +
                                      (with_grav ? stream("GRAV", 3, grav) : ""))});
  }
};

double angle_between_turns(const glm::dquat& a, const glm::dquat& b) {
  return 2 * std::acos(std::min(1.0, std::abs(glm::dot(a, b))));
}

}  // namespace

TEST_CASE("the attitude of stabilised footage is CORI * IORI, level by GRAV, its yaw from the first sample on") {
  const StabilisedFlight flight;
  const Result<Track> track = flight.read(true, true);
  REQUIRE(track);
  CHECK(track->ned_from_camera.source == "GPMF CORI * IORI");
  CHECK(track->level_is_known);
  CHECK(track->attitude_is_whole);
  CHECK_FALSE(track->heading_is_north);
  REQUIRE(track->ned_from_camera.values.size() == 10);
  const double yaw_rad = attitude_of(flight.world_from_image[0]).yaw_rad;
  for (std::size_t i = 0; i < 10; ++i)  // floats have 24 bits: some 1e-7; the arc cosine takes the root of that
    CHECK(angle_between_turns(track->ned_from_camera.values[i],
                              rotation_of({0, 0, -yaw_rad}) * flight.world_from_image[i]) < 1e-3);
}

TEST_CASE("without GRAV, or where that does not turn with CORI, the attitude is against the first sample") {
  for (const double wrong_rad : {0.0, 0.2}) {
    const StabilisedFlight flight(wrong_rad);
    const Result<Track> track = flight.read(true, wrong_rad > 0);
    REQUIRE(track);
    CHECK_FALSE(track->level_is_known);
    CHECK(says(*track, "does not turn with CORI") == (wrong_rad > 0));
    for (std::size_t i = 0; i < 10; ++i)
      CHECK(angle_between_turns(track->ned_from_camera.values[i],
                                glm::conjugate(flight.world_from_image[0]) * flight.world_from_image[i]) < 1e-3);
  }
  CHECK(StabilisedFlight().read(false, true)->ned_from_camera.source == "GPMF CORI");
}
