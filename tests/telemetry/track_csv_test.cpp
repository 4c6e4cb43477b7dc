// SPDX-License-Identifier: MIT
#include "telemetry/track_csv.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <map>
#include <random>
#include <string>

#include "base/pose.h"
#include "support/test_data.h"
#include "telemetry/track.h"

using namespace sigs;
using namespace sigs::test;
namespace {

double random_number(std::mt19937& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random()) / 4294967295.0;
}

void fill(std::mt19937& random, GeodeticPosition& value) {
  value = {random_number(random, -90, 90), random_number(random, -180, 180), random_number(random, -100, 9000)};
}
void fill(std::mt19937& random, glm::dvec3& value) {
  value = {random_number(random, -9, 9), random_number(random, -1e-7, 1e-7), random_number(random, -1e6, 1e6)};
}
void fill(std::mt19937& random, glm::dquat& value) {
  value = rotation_of({random_number(random, -3, 3), random_number(random, -1.4, 1.4), random_number(random, -3, 3)});
}
void fill(std::mt19937& random, double& value) {
  value = random_number(random, 1e-4, 0.04);
}

double difference(const GeodeticPosition& a, const GeodeticPosition& b) {
  return std::abs(a.latitude_deg - b.latitude_deg) + std::abs(a.longitude_deg - b.longitude_deg) +
         std::abs(a.height_m - b.height_m);
}
double difference(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::distance(a, b) / std::max(1.0, glm::length(a));
}
double difference(const glm::dquat& a, const glm::dquat& b) {
  return 1 - std::abs(glm::dot(a, b));
}
double difference(double a, double b) {
  return std::abs(a - b);
}

// Every channel has samples, at instants of its own and at some that it shares.
Track full_track() {
  std::mt19937 random(3);
  Track track{.format = "PX4 ULog", .device = "a, b \"c\"", .on_footage_time = true, .utc_at_zero_s = 1492457277.29};
  track.heading_is_north = false;
  track.level_is_known = false;
  track.attitude_is_whole = true;
  track.height_above_ellipsoid = true;
  track.readout_s = 0.0158;
  track.damaged = true;
  track.warnings = {{"GYRO", "two gaps"}, {"", "another"}};
  int n = 0;
  for_each_channel(track, [&](std::string_view name, auto& channel) {
    ++n;
    channel.source = "source of " + std::string(name);
    channel.clock = "clock";
    for (int i = 0; i < 20 + n; ++i) {
      channel.times_s.push_back(i < 5 ? i * 0.1 : i == 6 ? channel.times_s.back() : i * 0.1 + n * 1e-3);
      channel.values.emplace_back();
      fill(random, channel.values.back());
      if (n % 2 == 0) channel.own_times_s.push_back(1e6 + i * 0.1 - (i > 10 ? 4294.967296 : 0));
    }
  });
  return track;
}

bool warns(const Result<Track>& track, const std::string& words) {
  if (track)
    for (const Warning& warning : track->warnings)
      if (warning.text().find(words) != std::string::npos) return true;
  return false;
}

}  // namespace

TEST_CASE("a track that is written as CSV and read again is the same track") {
  const Track track = full_track();
  const std::string text = track_csv_text(track);
  CHECK(is_track_csv(text));
  const Result<Track> read = track_of_csv(text, "log.csv");
  REQUIRE(read);
  CHECK(read->format == track.format);
  CHECK(read->device == track.device);
  CHECK(read->on_footage_time);
  CHECK(read->utc_at_zero_s == track.utc_at_zero_s);
  CHECK_FALSE(read->heading_is_north);
  CHECK_FALSE(read->level_is_known);
  CHECK(read->attitude_is_whole);
  CHECK(read->height_above_ellipsoid);
  CHECK(read->readout_s == track.readout_s);
  CHECK(read->damaged);
  REQUIRE(read->warnings.size() == 2);
  CHECK(read->warnings[0].text() == track.warnings[0].text());
  std::vector<std::string> problems;
  for_each_channel(track, [&](std::string_view name, const auto& written) {
    for_each_channel(*read, [&](std::string_view other, const auto& again) {
      if constexpr (std::is_same_v<decltype(written), decltype(again)>) {
        if (other != name) return;
        CAPTURE(std::string(name));
        CHECK(again.source == written.source);
        CHECK(again.clock == written.clock);
        CHECK(again.times_s == written.times_s);
        CHECK(again.own_times_s == written.own_times_s);
        REQUIRE(again.values.size() == written.values.size());
        for (std::size_t i = 0; i < written.values.size(); ++i)
          CHECK(difference(again.values[i], written.values[i]) < 1e-9);
      }
    });
  });
}

TEST_CASE("columns of other programs are understood, and unknown ones are named") {
  const std::string text =
      "\xEF\xBB\xBF# recorded by hand\r\nTime,LAT,Lon,Alt,battery\r\n0,47.5,8.5,400,12\r\n0.5,47.6,8.5,401,\r\n";
  CHECK(is_track_csv(text));
  const Result<Track> track = track_of_csv(text, "log.csv");
  REQUIRE(track);
  REQUIRE(track->position.values.size() == 2);
  CHECK(track->position.values[1] == GeodeticPosition{47.6, 8.5, 401});
  CHECK(warns(track, "battery"));
  CHECK_FALSE(track->on_footage_time);
}

TEST_CASE("rows by frame number need the frame rate") {
  const Result<Track> track = track_of_csv("# frame_rate: 30000/1001\nframe,exposure_s\n0,0.01\n30,0.02\n", "log.csv");
  REQUIRE(track);
  CHECK(track->on_footage_time);
  CHECK(track->exposure_s.times_s[1] == doctest::Approx(1.001));
  const Result<Track> without = track_of_csv("frame,exposure_s\n0,0.01\n", "log.csv");
  REQUIRE(!without);
  CHECK(without.error().text().find("frame_rate") != std::string::npos);
}

TEST_CASE("cells that are no numbers and rows that go back in time are left out and named with their line") {
  const Result<Track> track = track_of_csv(
      "time_s,vn_mps,ve_mps,vd_mps\n1,1,2,3\n2,nan,2,3\n1.5,x,2,3\n0,1,1,1\n3,1,,3\n4,,,\n5,4,5,6\n", "log.csv");
  REQUIRE(track);
  CHECK(track->velocity_ned_mps.values.size() == 2);
  CHECK(track->velocity_ned_mps.times_s.back() == 5);
  CHECK(warns(track, "line 3"));
  CHECK(warns(track, "line 4: its time is before"));
  CHECK(warns(track, "line 6: velocity_ned_mps has only some"));
}

TEST_CASE("a file without a whole channel is an error, and other texts are no flight log") {
  CHECK_FALSE(track_of_csv("time_s,vn_mps\n1,2\n", "log.csv"));
  CHECK_FALSE(track_of_csv("time_s,latitude_deg,longitude_deg\n", "log.csv"));
  CHECK_FALSE(is_track_csv("1\n00:00:00,000 --> 00:00:01,000\nlat\n"));
  CHECK_FALSE(is_track_csv("name,size\nx,1\n"));
  CHECK_FALSE(is_track_csv(""));
}

TEST_CASE("a file of CSV is recognised by its content, whatever its name") {
  const TemporaryFolder folder;
  write_file(folder / "flight.dat", "time_s,exposure_s\n0,0.01\n");
  const Result<Track> track = read_track(folder / "flight.dat");
  REQUIRE(track);
  CHECK(track->exposure_s.values.size() == 1);
  write_file(folder / "flight.txt", "nothing of the kind\n");
  const Result<Track> other = read_track(folder / "flight.txt");
  REQUIRE(!other);
  CHECK(other.error().kind == ErrorKind::bad_data);
}

namespace {

// Rows of 20 Hz with their number as speed, the times of some of them replaced.
Result<Track> track_with_times(const std::map<int, double>& replaced, int rows = 200) {
  std::string text = "time_s,vn_mps,ve_mps,vd_mps\n";
  for (int i = 0; i < rows; ++i)
    text += fmt::format("{},{},0,0\n", replaced.contains(i) ? replaced.at(i) : 0.05 * i, i);
  return track_of_csv(text, "log.csv");
}

std::size_t warnings_about(const Track& track, const std::string& words) {
  return static_cast<std::size_t>(std::count_if(track.warnings.begin(), track.warnings.end(), [&](const Warning& w) {
    return w.text().find(words) != std::string::npos;
  }));
}

}  // namespace

TEST_CASE("rows whose times are far from their neighbours' are left out alone and counted in one line") {
  struct Case {
    std::map<int, double> replaced;
    int first_line;
  };
  for (const Case& one : {Case{{{50, 999999}}, 52}, Case{{{0, 999999}}, 2}, Case{{{199, 999999}}, 201},
                          Case{{{198, 999999}}, 200}, Case{{{0, -1e9}}, 2}, Case{{{50, -7}}, 52},
                          Case{{{50, 999999}, {51, 999999.05}, {52, 1e6}, {120, 3}, {150, 1e7}}, 52}}) {
    CAPTURE(one.first_line);
    CAPTURE(one.replaced.begin()->second);
    const Result<Track> track = track_with_times(one.replaced);
    REQUIRE(track);
    const Channel<glm::dvec3>& speeds = track->velocity_ned_mps;
    CHECK(speeds.values.size() == 200 - one.replaced.size());
    for (std::size_t i = 0; i < speeds.values.size(); ++i)
      CHECK(speeds.times_s[i] == doctest::Approx(0.05 * speeds.values[i].x));
    CHECK(track->warnings.size() == 1);
    CHECK(warns(*track, fmt::format("line {}: ", one.first_line)));
    CHECK(warns(*track, one.replaced.size() == 1 ? "1 such row left out" : "5 such rows left out"));
  }
}

TEST_CASE("a pause, and a clock that is set, are no outliers") {
  // After a pause two samples more; it is longer than all before it, but not than a thousand intervals.
  const Result<Track> paused = track_with_times({{18, 3}, {19, 3.05}}, 20);
  CHECK(paused->velocity_ned_mps.values.size() == 20);
  // From row 100 on the clock is an hour ahead.
  std::map<int, double> ahead;
  for (int i = 100; i < 200; ++i) ahead[i] = 3600 + 0.05 * i;
  CHECK(track_with_times(ahead)->velocity_ned_mps.values.size() == 200);
  // From row 100 on it begins again: what it has gone through stays, what follows is left out in one line.
  std::map<int, double> again;
  for (int i = 100; i < 190; ++i) again[i] = 0.05 * (i - 100);
  const Result<Track> track = track_with_times(again, 190);
  CHECK(track->velocity_ned_mps.values.size() == 100);
  CHECK(track->velocity_ned_mps.times_s.back() == doctest::Approx(0.05 * 99));
  CHECK(warnings_about(*track, "90 such rows left out") == 1);
}

TEST_CASE("a file that is missing is an error that names it") {
  const Result<Track> track = read_track("/nowhere/flight.ulg");
  REQUIRE(!track);
  CHECK(track.error().kind == ErrorKind::cannot_read);
}
