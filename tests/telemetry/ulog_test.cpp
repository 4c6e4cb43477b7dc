// SPDX-License-Identifier: MIT
#include "telemetry/log_formats.h"

#include <doctest/doctest.h>

#include <cstring>
#include <fstream>
#include <iterator>

#include "broken_bytes.h"
#include "support/test_data.h"
#include "telemetry/track.h"

using namespace sigs;
using namespace sigs::test;

namespace {

std::filesystem::path sample_ulog() {
  return real_data() / "telemetry" / "autopilot" / "sample_log_small.ulg";
}

std::string ulog_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

template <class T>
T copied(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

// The places of a topic's data (instance 0) in the file, found without its formats: the offsets of the fields below are
// counted by hand from the F messages of the sample.
std::vector<std::size_t> data_of(const std::string& bytes, const std::string& topic) {
  std::vector<std::size_t> found;
  int id = -1;
  for (std::size_t at = 16; at + 3 < bytes.size(); at += 3 + copied<std::uint16_t>(bytes, at)) {
    const std::size_t size = copied<std::uint16_t>(bytes, at);
    if (bytes[at + 2] == 'A' && bytes[at + 3] == 0 && bytes.substr(at + 6, size - 3) == topic)
      id = copied<std::uint16_t>(bytes, at + 4);
    if (bytes[at + 2] == 'D' && copied<std::uint16_t>(bytes, at + 3) == id) found.push_back(at + 5);
  }
  return found;
}

// A ULog written by hand, little-endian machines only.
struct UlogWriter {
  std::string bytes = std::string("ULog\x01\x12\x35\x01", 8) + number<std::uint64_t>(1'000'000);
  template <class T>
  static std::string number(T value) {
    std::string text(sizeof value, '\0');
    std::memcpy(text.data(), &value, sizeof value);
    return text;
  }
  void message(char type, const std::string& body) {
    bytes += number(static_cast<std::uint16_t>(body.size())) + type + body;
  }
  void topic(std::uint16_t id, const std::string& name, const std::string& fields, char instance = 0) {
    message('F', name + ":" + fields);
    message('A', std::string(1, instance) + number(id) + name);
  }
};

}  // namespace

TEST_CASE("attitude and places of a PX4 log are the numbers at their places in the file") {
  if (!has_real_data()) return;
  const std::string bytes = ulog_bytes(sample_ulog());
  const Result<Track> track = read_track(sample_ulog());
  REQUIRE(track);
  CHECK(track->format == "PX4 ULog");
  CHECK(!track->damaged);
  CHECK(is_in_order(*track));

  const std::vector<std::size_t> attitudes = data_of(bytes, "vehicle_attitude");
  REQUIRE(attitudes.size() == 1298);  // counted by a separate program too
  REQUIRE(track->ned_from_airframe.values.size() == attitudes.size());
  for (std::size_t i = 0; i < attitudes.size(); ++i) {
    const glm::dquat& q = track->ned_from_airframe.values[i];
    CHECK(track->ned_from_airframe.own_times_s[i] ==
          doctest::Approx(1e-6 * static_cast<double>(copied<std::uint64_t>(bytes, attitudes[i]))));
    // Stored in single precision, here brought to length 1.
    CHECK(std::abs(q.w - copied<float>(bytes, attitudes[i] + 8)) < 1e-6);
    CHECK(std::abs(q.x - copied<float>(bytes, attitudes[i] + 12)) < 1e-6);
    CHECK(std::abs(q.y - copied<float>(bytes, attitudes[i] + 16)) < 1e-6);
    CHECK(std::abs(q.z - copied<float>(bytes, attitudes[i] + 20)) < 1e-6);
  }
  // Time 0 is the file's own stamp, 20.309082 s; the first attitude was measured at 20.326716 s.
  CHECK(track->ned_from_airframe.times_s.front() == doctest::Approx(0.017634).epsilon(1e-9));

  const std::vector<std::size_t> places = data_of(bytes, "vehicle_gps_position");
  REQUIRE(places.size() == 32);
  REQUIRE(track->position.values.size() == places.size());
  CHECK(track->height_above_ellipsoid);
  for (std::size_t i = 0; i < places.size(); ++i) {
    CHECK(track->position.values[i].latitude_deg ==
          doctest::Approx(copied<std::int32_t>(bytes, places[i] + 16) * 1e-7).epsilon(1e-14));
    CHECK(track->position.values[i].longitude_deg ==
          doctest::Approx(copied<std::int32_t>(bytes, places[i] + 20) * 1e-7).epsilon(1e-14));
    CHECK(track->position.values[i].height_m == doctest::Approx(copied<std::int32_t>(bytes, places[i] + 28) * 1e-3));
  }
  // time_utc_usec 1618986658.600345 of the receiver at 20.471648 s since boot.
  REQUIRE(track->utc_at_zero_s);
  CHECK(*track->utc_at_zero_s == doctest::Approx(1618986658.600345 - 20.471648 + 20.309082).epsilon(1e-13));
}

TEST_CASE("rates, forces and the dropout of a PX4 log are read") {
  if (!has_real_data()) return;
  const std::string bytes = ulog_bytes(sample_ulog());
  const Result<Track> track = ulog_track(bytes, "sample");
  REQUIRE(track);
  const std::vector<std::size_t> rates = data_of(bytes, "vehicle_angular_velocity");
  const std::vector<std::size_t> forces = data_of(bytes, "sensor_combined");
  REQUIRE(track->airframe_rate_radps.values.size() == rates.size());
  REQUIRE(track->airframe_force_mps2.values.size() == forces.size());
  for (std::size_t i = 0; i < rates.size(); ++i) {
    CHECK(track->airframe_rate_radps.values[i].z == copied<float>(bytes, rates[i] + 24));
    // timestamp_sample, not timestamp: the rate was measured some 0.4 ms before it was published.
    CHECK(track->airframe_rate_radps.own_times_s[i] ==
          doctest::Approx(1e-6 * static_cast<double>(copied<std::uint64_t>(bytes, rates[i] + 8))));
  }
  for (std::size_t i = 0; i < forces.size(); ++i)
    CHECK(track->airframe_force_mps2.values[i].z == copied<float>(bytes, forces[i] + 36));
  CHECK(warnings_with(*track, "lost 0.03 s of all topics") == 1);
}

TEST_CASE("a local position that PX4 says is not valid is left out, and read where it is") {
  if (!has_real_data()) return;
  std::string bytes = ulog_bytes(sample_ulog());
  const Result<Track> invalid = ulog_track(bytes, "sample");
  REQUIRE(invalid);
  CHECK(invalid->local_position_ned_m.empty());
  CHECK(warnings_with(*invalid, "636 samples left out, the first at 0.012745 s: xy_valid") == 1);

  const std::vector<std::size_t> rows = data_of(bytes, "vehicle_local_position");
  for (const std::size_t row : rows) bytes[row + 144] = bytes[row + 146] = 1;  // xy_valid, v_xy_valid
  const Result<Track> valid = ulog_track(bytes, "sample");
  REQUIRE(valid);
  REQUIRE(valid->local_position_ned_m.values.size() == rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const glm::dvec3 p(copied<float>(bytes, rows[i] + 32), copied<float>(bytes, rows[i] + 36),
                       copied<float>(bytes, rows[i] + 40));
    const glm::dvec3 v(copied<float>(bytes, rows[i] + 56), copied<float>(bytes, rows[i] + 60),
                       copied<float>(bytes, rows[i] + 64));
    CHECK(valid->local_position_ned_m.values[i] == p);
    CHECK(valid->velocity_ned_mps.values[i] == v);
  }
}

TEST_CASE("a gimbal's yaw counts from north or from the nose, as its flags say") {
  UlogWriter log;
  const auto quarter = [](double yaw_deg) {  // a turn about Z
    const float half = static_cast<float>(yaw_deg * 3.14159265358979 / 360);
    return UlogWriter::number(std::cos(half)) + UlogWriter::number(0.0F) + UlogWriter::number(0.0F) +
           UlogWriter::number(std::sin(half));
  };
  log.message('F', "inner:float a;float b;");
  log.topic(1, "vehicle_attitude", "uint64_t timestamp;inner[2] nested;float[4] q;uint8_t[4] _padding0;");
  log.topic(2, "gimbal_device_attitude_status", "uint64_t timestamp;uint16_t device_flags;float[4] q;");
  log.topic(3, "vehicle_attitude", "uint64_t timestamp;inner[2] nested;float[4] q;uint8_t[4] _padding0;", 1);
  log.message('D', UlogWriter::number<std::uint16_t>(1) + UlogWriter::number<std::uint64_t>(2'000'000) +
                       std::string(16, 'x') + quarter(90));
  log.message('D', UlogWriter::number<std::uint16_t>(2) + UlogWriter::number<std::uint64_t>(2'100'000) +
                       UlogWriter::number<std::uint16_t>(64) + quarter(30));
  log.message('D', UlogWriter::number<std::uint16_t>(2) + UlogWriter::number<std::uint64_t>(2'200'000) +
                       UlogWriter::number<std::uint16_t>(32) + quarter(30));
  const Result<Track> track = ulog_track(log.bytes, "made");
  REQUIRE(track);
  REQUIRE(track->ned_from_camera.values.size() == 2);
  const auto north_of = [&](std::size_t i) { return track->ned_from_camera.values[i] * glm::dvec3(1, 0, 0); };
  CHECK(north_of(0).x == doctest::Approx(std::cos(3.14159265358979 / 6)));      // 30 degrees from north
  CHECK(north_of(1).x == doctest::Approx(std::cos(3.14159265358979 * 2 / 3)));  // 30 degrees from a nose to the east
  CHECK(track->ned_from_camera.times_s[1] == doctest::Approx(1.2));
  CHECK(warnings_with(*track, "instance 1 is not read") == 1);
}

TEST_CASE("a broken PX4 log is read up to and behind the damage, or refused") {
  if (!has_real_data()) return;
  const std::string bytes = ulog_bytes(sample_ulog());
  const auto read = [](std::string_view broken) { return ulog_track(broken, "broken.ulg"); };
  std::string holed = bytes;
  holed.replace(300000, 500, std::string(500, '\xEE'));
  const Result<Track> track = read(holed);
  REQUIRE(track);
  CHECK(track->damaged);
  CHECK(warnings_with(*track, "skipped up to the next synchronisation message") >= 1);
  CHECK(track->ned_from_airframe.times_s.back() > 6.4);  // the end of the file is there
  const Result<Track> cut = read(bytes.substr(0, 500001));
  REQUIRE(cut);
  CHECK(cut->damaged);
  CHECK(!read(bytes.substr(0, 60000)));  // the definitions only
  CHECK(survives(bytes, read, 150, 0, bytes.size()));
  CHECK(survives(bytes.substr(0, 150000), read, 0, 200, 70000));

  std::string unknown = bytes;
  unknown[16 + 3 + 8] |= 2;  // an incompatible flag
  CHECK(!read(unknown));
}

TEST_CASE("stamps of a PX4 log that jump ahead and come back cost those samples alone") {
  UlogWriter log;
  log.topic(1, "vehicle_angular_velocity", "uint64_t timestamp;float[3] xyz;");
  const auto add = [&](std::uint64_t us) {
    log.message('D', UlogWriter::number<std::uint16_t>(1) + UlogWriter::number(us) + UlogWriter::number(0.1F) +
                         UlogWriter::number(0.2F) + UlogWriter::number(0.3F));
  };
  // Five samples in a row, then a single one that is behind.
  for (std::uint64_t i = 0; i < 200; ++i)
    add(2'000'000 + 4'000 * i + (i >= 50 && i < 55 ? 3'600'000'000 : 0) - (i == 120 ? 900'000 : 0));
  const Result<Track> track = ulog_track(log.bytes, "made");
  REQUIRE(track);
  CHECK(track->airframe_rate_radps.values.size() == 194);
  CHECK(warnings_with(*track, "6 samples left out") == 1);
  CHECK(is_in_order(*track));
}
