// SPDX-License-Identifier: MIT
// A real clip of a GoPro on a Karma drone, against a decoding of its telemetry by another program.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "base/pose.h"
#include "support/test_data.h"
#include "telemetry/track.h"

using namespace sigs;
using namespace sigs::test;
namespace {

// Rows of numbers, without the first line and the first column (the row's number).
std::vector<std::vector<double>> karma_rows(const std::string& name) {
  std::ifstream in(real_data() / "telemetry" / "gopro" / name);
  std::vector<std::vector<double>> rows;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::vector<double> row;
    for (std::string word; std::getline(words, word, ',');) row.push_back(std::stod(word));
    row.erase(row.begin());
    rows.push_back(row);
  }
  return rows;
}

const std::filesystem::path& karma_clip() {
  static const std::filesystem::path path = real_data() / "video" / "air_karma_gopro_coast.mp4";
  return path;
}

// The other decoding is written with nine digits.
bool is_same(double a, double b) {
  return std::abs(a - b) <= 2e-8 * std::max(std::abs(b), 1e-2);
}

bool same_vector(const glm::dvec3& a, double x, double y, double z) {
  return is_same(a.x, x) && is_same(a.y, y) && is_same(a.z, z);
}

}  // namespace

TEST_CASE("every sample of a real clip's gyroscope, accelerometer and exposure agrees with another decoding") {
  if (!has_real_data()) return;
  const Result<Track> track = read_track(karma_clip());
  REQUIRE(track);
  CHECK(track->format == "GoPro GPMF");
  CHECK(track->on_footage_time);
  CHECK_FALSE(track->damaged);
  // Columns are up, left, backwards (gopro_stream.h).
  const auto gyro = karma_rows("karma_gyro.csv");
  REQUIRE(track->camera_rate_radps.values.size() == gyro.size());
  int differ = 0;
  for (std::size_t i = 0; i < gyro.size(); ++i)
    differ += !same_vector(track->camera_rate_radps.values[i], -gyro[i][2], -gyro[i][1], -gyro[i][0]);
  CHECK(differ == 0);
  const auto force = karma_rows("karma_accl.csv");
  REQUIRE(track->camera_force_mps2.values.size() == force.size());
  for (std::size_t i = 0; i < force.size(); ++i)
    differ += !same_vector(track->camera_force_mps2.values[i], -force[i][2], -force[i][1], -force[i][0]);
  CHECK(differ == 0);
  const auto shutter = karma_rows("karma_shut.csv");
  REQUIRE(track->exposure_s.values.size() == shutter.size());
  for (std::size_t i = 0; i < shutter.size(); ++i) differ += !is_same(track->exposure_s.values[i], shutter[i][0]);
  CHECK(differ == 0);
}

TEST_CASE("every sample of a real drone's attitude, local position and place agrees with another decoding") {
  if (!has_real_data()) return;
  const Result<Track> track = read_track(karma_clip());
  REQUIRE(track);
  int differ = 0;
  const auto attitude = karma_rows("karma_attd.csv");
  REQUIRE(track->ned_from_airframe.values.size() == attitude.size());
  for (std::size_t i = 0; i < attitude.size(); ++i) {
    const Attitude read = attitude_of(track->ned_from_airframe.values[i]);
    differ += !is_same(read.roll_rad, attitude[i][1]) || !is_same(read.pitch_rad, attitude[i][2]) ||
              !is_same(read.yaw_rad, attitude[i][3]) ||
              !is_same(track->ned_from_airframe.own_times_s[i], attitude[i][0]);
    differ += !same_vector(track->airframe_rate_radps.values[i], attitude[i][4], attitude[i][5], attitude[i][6]);
  }
  CHECK(differ == 0);
  const auto local = karma_rows("karma_lned.csv");
  REQUIRE(track->local_position_ned_m.values.size() == local.size());
  for (std::size_t i = 0; i < local.size(); ++i) {
    differ += !same_vector(track->local_position_ned_m.values[i], local[i][1], local[i][2], local[i][3]);
    differ += !same_vector(track->velocity_ned_mps.values[i], local[i][4], local[i][5], local[i][6]);
  }
  CHECK(differ == 0);
  const auto place = karma_rows("karma_glpi.csv");
  REQUIRE(track->position.values.size() == place.size());
  for (std::size_t i = 0; i < place.size(); ++i) {
    const GeodeticPosition& read = track->position.values[i];
    // The other decoding has seven decimals of 33 degrees, nine digits.
    differ += std::abs(read.latitude_deg - place[i][1]) > 1e-6 || std::abs(read.longitude_deg - place[i][2]) > 1e-6 ||
              !is_same(read.height_m, place[i][3]);
  }
  CHECK(differ == 0);
}

TEST_CASE("the samples of a real clip lie where its own streams say they were taken") {
  if (!has_real_data()) return;
  const Result<Track> track = read_track(karma_clip());
  REQUIRE(track);
  // 362 frames at 30000/1001 Hz; the gyroscope ran through all of them at an even rate near its nominal 400 Hz.
  const std::vector<double>& times_s = track->camera_rate_radps.times_s;
  CHECK(std::abs(times_s.front()) < 0.05);
  CHECK(std::abs(times_s.back() - 362 * 1001.0 / 30000) < 0.05);
  const double rate_hz = static_cast<double>(times_s.size() - 1) / (times_s.back() - times_s.front());
  CHECK(rate_hz > 396);
  CHECK(rate_hz < 400);
  // The drone's clock runs as the footage's does: its stamps are 11.6 s apart from first to last, all within the clip.
  CHECK(track->ned_from_airframe.times_s.front() > -0.3);
  CHECK(track->ned_from_airframe.times_s.back() < 12.1);
  // At rest an accelerometer measures 9.8 m/s^2 upwards; Z is down. The drone holds its height on average.
  glm::dvec3 mean{0};
  for (const glm::dvec3& force : track->camera_force_mps2.values) mean += force;
  CHECK(std::abs(mean.z / static_cast<double>(track->camera_force_mps2.values.size()) + 9.81) < 0.3);
  // While the drone gains speed, from 0.9 to 8 m/s northwest with its nose there, the force is forward.
  CHECK(track->camera_force_mps2.values[40].x > 1);
  // The camera turns right by 0.17 rad in the last half second: the content of the image moves left by some 90 px.
  double turned_rad = 0;
  for (std::size_t i = 1; i < times_s.size(); ++i)
    if (times_s[i] > 11.5) turned_rad += track->camera_rate_radps.values[i].z * (times_s[i] - times_s[i - 1]);
  CHECK(turned_rad > 0.15);
  // 2017-04-17 19:27:58 UTC, as the drone has it and the container's creation time within 3 s.
  REQUIRE(track->utc_at_zero_s);
  CHECK(std::abs(*track->utc_at_zero_s - 1492457277) < 3);
}
