// SPDX-License-Identifier: MIT
#include "telemetry/log_formats.h"

#include <doctest/doctest.h>

#include <cstring>

#include "base/pose.h"
#include "broken_bytes.h"
#include "support/test_data.h"
#include "telemetry/track.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// Writes a log as ArduPilot's documentation of its messages has it; little-endian machines only.
struct DataflashWriter {
  std::string bytes;

  DataflashWriter() { format(128, 89, "FMT", "BBnNZ", "Type,Length,Name,Format,Columns"); }

  static std::string padded(std::string text, std::size_t size) {
    text.resize(size, '\0');
    return text;
  }
  static std::string head(int type) { return std::string("\xA3\x95") + static_cast<char>(type); }
  void format(int type, int length, const std::string& name, const std::string& letters, const std::string& columns) {
    bytes += head(128) + static_cast<char>(type) + static_cast<char>(length) + padded(name, 4) + padded(letters, 16) +
             padded(columns, 64);
  }
  template <class... Numbers>
  void message(int type, Numbers... numbers) {
    bytes += head(type);
    (add(numbers), ...);
  }
  template <class T>
  void add(T value) {
    std::string text(sizeof value, '\0');
    std::memcpy(text.data(), &value, sizeof value);
    bytes += text;
  }
};

using U8 = std::uint8_t;
using U16 = std::uint16_t;
using I16 = std::int16_t;
using U32 = std::uint32_t;
using I32 = std::int32_t;
using U64 = std::uint64_t;

// A flight with the formats of ArduCopter 4: all messages that are read, `count` of each, from 5 s after boot on. All
// messages of one moment are stamped with a jump.
DataflashWriter flight(int count = 10, int jump_at = -1, U64 jump_us = 0) {
  DataflashWriter log;
  log.format(10, 3 + 8 + 64, "MSG", "QZ", "TimeUS,Message");
  log.format(11, 3 + 8 + 1 + 32, "FMTU", "QBNN", "TimeUS,FmtType,UnitIds,MultIds");
  log.format(12, 3 + 8 + 1 + 8, "MULT", "Qbd", "TimeUS,Id,Mult");
  log.format(13, 3 + 8 + 12, "ATT", "QccccCC", "TimeUS,DesRoll,Roll,DesPitch,Pitch,DesYaw,Yaw");
  log.format(14, 3 + 48, "GPS", "QBBIHBcLLeffffB", "TimeUS,I,Status,GMS,GWk,NSats,HDop,Lat,Lng,Alt,Spd,GCrs,VZ,Yaw,U");
  log.format(15, 3 + 8 + 1 + 24, "IMU", "QBffffff", "TimeUS,I,GyrX,GyrY,GyrZ,AccX,AccY,AccZ");
  log.format(16, 3 + 8 + 1 + 6 + 28, "XKF1", "QBccCfffffff", "TimeUS,C,Roll,Pitch,Yaw,VN,VE,VD,dPD,PN,PE,PD");
  log.format(17, 3 + 8 + 8 + 4, "POS", "QLLf", "TimeUS,Lat,Lng,Alt");
  log.format(18, 3 + 8 + 1 + 36, "MNT", "QBfffffffff", "TimeUS,I,DRoll,Roll,DPitch,Pitch,DYawB,YawB,DYawE,YawE,Dist");
  log.bytes += DataflashWriter::head(10) + std::string(8, '\0') + DataflashWriter::padded("ArduCopter V4.5.7", 64);
  for (int i = 0; i < count; ++i) {
    const U64 us = 5'000'000 + static_cast<U64>(i) * 100'000 + (i == jump_at ? jump_us : 0);
    log.message(13, us, I16{0}, static_cast<I16>(100 * i), I16{0}, I16{-1250}, U16{0}, U16{27000});
    log.message(14, us, U8{0}, U8{3}, U32{302'400'500} + static_cast<U32>(100 * i), U16{2200}, U8{12}, I16{80},
                I32{473'000'000 + i}, I32{-85'000'000}, I32{45'678}, 10.0F, 90.0F, -2.0F, 0.0F, U8{1});
    log.message(14, us, U8{1}, U8{3}, U32{0}, U16{0}, U8{0}, I16{0}, I32{1}, I32{1}, I32{0}, 0.0F, 0.0F, 0.0F, 0.0F,
                U8{0});
    log.message(15, us, U8{0}, 0.1F, 0.2F, 0.3F, 0.0F, 0.0F, -9.8F);
    log.message(16, us, U8{0}, I16{0}, I16{0}, U16{0}, 1.0F, 2.0F, 3.0F, 0.0F, 10.0F, 20.0F, -30.0F);
    log.message(17, us, I32{473'000'100 + i}, I32{-85'000'000}, 460.25F);
    log.message(18, us, U8{0}, 0.0F, 1.0F, 0.0F, -45.0F, 0.0F, 5.0F, 0.0F, std::nanf(""), 0.0F);
  }
  return log;
}

Result<Track> dataflash_of(std::string_view bytes) {
  return dataflash_track(bytes, "made.bin");
}

}  // namespace

TEST_CASE("a dataflash log gives back what was written into it") {
  const Result<Track> track = dataflash_of(flight().bytes);
  REQUIRE(track);
  CHECK(track->device == "ArduCopter V4.5.7");
  CHECK(!track->damaged);
  CHECK(is_in_order(*track));
  REQUIRE(track->ned_from_airframe.values.size() == 10);
  CHECK(track->ned_from_airframe.times_s[3] == doctest::Approx(0.3));
  CHECK(track->ned_from_airframe.own_times_s[3] == doctest::Approx(5.3));
  const Attitude attitude = attitude_of(track->ned_from_airframe.values[3]);
  CHECK(deg_of_rad(attitude.roll_rad) == doctest::Approx(3));
  CHECK(deg_of_rad(attitude.pitch_rad) == doctest::Approx(-12.5));
  CHECK(deg_of_rad(attitude.yaw_rad) == doctest::Approx(-90));
  CHECK(track->position.source == "POS");
  CHECK(track->position.values[2].latitude_deg == doctest::Approx(47.3000102).epsilon(1e-12));
  CHECK(track->position.values[2].longitude_deg == doctest::Approx(-8.5).epsilon(1e-12));
  CHECK(track->position.values[2].height_m == 460.25);
  CHECK(!track->height_above_ellipsoid);
  CHECK(track->velocity_ned_mps.values[0] == glm::dvec3(1, 2, 3));
  CHECK(track->local_position_ned_m.values[0] == glm::dvec3(10, 20, -30));
  CHECK(track->airframe_rate_radps.values[0].z == doctest::Approx(0.3).epsilon(1e-6));
  CHECK(track->airframe_force_mps2.values[0].z == doctest::Approx(-9.8).epsilon(1e-6));
  // The gimbal has no yaw from north: 5 degrees from a nose at 270.
  const Attitude gimbal = attitude_of(track->ned_from_camera.values[0]);
  CHECK(deg_of_rad(gimbal.pitch_rad) == doctest::Approx(-45));
  CHECK(deg_of_rad(gimbal.yaw_rad) == doctest::Approx(-85));
  // Week 2200 began on 2022-03-06, 1646524800 s; 3.5 days and half a second later, less 18 leap seconds.
  REQUIRE(track->utc_at_zero_s);
  CHECK(*track->utc_at_zero_s == doctest::Approx(1646524800 + 302400.5 - 18).epsilon(1e-13));
  CHECK(warnings_with(*track, "only the first instance") == 1);
}

TEST_CASE("the receiver's velocity is speed along the course, and no fix gives no place") {
  DataflashWriter log;
  log.format(14, 3 + 48, "GPS", "QBBIHBcLLeffffB", "TimeUS,I,Status,GMS,GWk,NSats,HDop,Lat,Lng,Alt,Spd,GCrs,VZ,Yaw,U");
  for (const U8 status : {U8{1}, U8{3}, U8{6}})
    log.message(14, U64{1'000'000} + status * U64{100'000}, U8{0}, status, U32{0}, U16{1800}, U8{12}, I16{80},
                I32{473'000'000}, I32{85'000'000}, I32{45'678}, 10.0F, 90.0F, -2.0F, 0.0F, U8{1});
  const Result<Track> track = dataflash_of(log.bytes);
  REQUIRE(track);
  CHECK(track->position.values.size() == 2);
  CHECK(track->position.values[0].height_m == doctest::Approx(456.78));
  CHECK(warnings_with(*track, "no three-dimensional fix") == 1);
  CHECK(std::abs(track->velocity_ned_mps.values[0].x) < 1e-12);
  CHECK(track->velocity_ned_mps.values[0].y == doctest::Approx(10));
  CHECK(track->velocity_ned_mps.values[0].z == -2);
  // July 2014: 16 leap seconds; the week began at 1980-01-06 + 1800 weeks. The fix is at 0.2 s of the log.
  CHECK(*track->utc_at_zero_s == doctest::Approx(315964800.0 + 1800 * 604800.0 - 16 - 0.2).epsilon(1e-13));
}

TEST_CASE("a multiplier that the log states replaces that of the letter") {
  DataflashWriter log;
  log.format(11, 3 + 8 + 1 + 32, "FMTU", "QBNN", "TimeUS,FmtType,UnitIds,MultIds");
  log.format(12, 3 + 8 + 1 + 8, "MULT", "Qbd", "TimeUS,Id,Mult");
  log.format(13, 3 + 8 + 6, "ATT", "Qhhh", "TimeUS,Roll,Pitch,Yaw");
  log.message(12, U64{1}, 'A', 0.1);
  log.message(12, U64{1}, 'F', 1e-6);
  log.bytes += DataflashWriter::head(11) + std::string(8, '\0') + static_cast<char>(13) +
               DataflashWriter::padded("sddd", 16) + DataflashWriter::padded("FAAA", 16);
  log.message(13, U64{2'000'000}, I16{105}, I16{-200}, I16{900});
  const Result<Track> track = dataflash_of(log.bytes);
  REQUIRE(track);
  const Attitude attitude = attitude_of(track->ned_from_airframe.values[0]);
  CHECK(deg_of_rad(attitude.roll_rad) == doctest::Approx(10.5));
  CHECK(deg_of_rad(attitude.pitch_rad) == doctest::Approx(-20));
  CHECK(deg_of_rad(attitude.yaw_rad) == doctest::Approx(90));
  CHECK(track->ned_from_airframe.own_times_s[0] == 2);
}

TEST_CASE("bytes between messages are skipped and counted, and a cut tail is said") {
  const std::string whole = flight().bytes;
  const std::string front = whole.substr(0, whole.size() - 47 - 3 - 20);  // within the last messages
  const Result<Track> cut = dataflash_of(front);
  REQUIRE(cut);
  CHECK(cut->damaged);
  CHECK(warnings_with(*cut, "cut off or broken") == 1);

  DataflashWriter log = flight();
  log.bytes += "noise \xA3\x95\xF0 and \xA3\x95";  // heads of an unknown type and of none
  const std::size_t noise = log.bytes.size() - whole.size();
  log.message(13, U64{7'000'000}, I16{0}, I16{0}, I16{0}, I16{0}, U16{0}, U16{0});
  const Result<Track> track = dataflash_of(log.bytes);
  REQUIRE(track);
  CHECK(track->damaged);
  CHECK(track->ned_from_airframe.values.size() == 11);
  CHECK(warnings_with(*track, std::to_string(noise) + " bytes skipped") == 1);
  CHECK(warnings_with(*track, "no samples for 1.1 s after 0.9 s") == 1);
}

TEST_CASE("a definition that contradicts itself is left out") {
  DataflashWriter log = flight();
  log.format(40, 200, "ODD", "Qf", "TimeUS,Value");
  log.format(41, 12, "ODD2", "Q!", "TimeUS,Value");
  const Result<Track> track = dataflash_of(log.bytes);
  REQUIRE(track);
  CHECK(warnings_with(*track, "contradicts itself") == 2);
}

TEST_CASE("read_track knows a dataflash log by its first message, and a broken one does no harm") {
  const std::string bytes = flight().bytes;
  TemporaryFolder folder;
  write_file(folder / "flight.txt", bytes);
  const Result<Track> track = read_track(folder / "flight.txt");
  REQUIRE(track);
  CHECK(track->format == "ArduPilot dataflash");
  CHECK(!dataflash_of(DataflashWriter().bytes));  // definitions only
  CHECK(survives(bytes, dataflash_of, 300, 1000, bytes.size()));
}

TEST_CASE("a message stamped far ahead is left out alone, wherever it stands, and counted in one line") {
  for (const int jump_at : {1, 7, 18, 19}) {
    CAPTURE(jump_at);
    const Result<Track> track = dataflash_of(flight(20, jump_at, 999'999'000'000).bytes);
    REQUIRE(track);
    CHECK(track->ned_from_airframe.values.size() == 19);
    CHECK(track->ned_from_airframe.times_s.back() == doctest::Approx(jump_at == 19 ? 1.8 : 1.9));
    CHECK(track->position.values.size() == 19);
    CHECK(warnings_with(*track, "no samples for") == 0);
    CHECK(warnings_with(*track, "1 sample left out") == 7);  // one for each channel
    CHECK(is_in_order(*track));
  }
}
