// SPDX-License-Identifier: MIT
#include "telemetry/log_formats.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "base/pose.h"
#include "broken_bytes.h"
#include "support/test_data.h"
#include "telemetry/track.h"

using namespace sigs;
using namespace sigs::test;

namespace {

std::filesystem::path klv_clip() {
  return real_data() / "telemetry" / "klv" / "h264_klv.ts";
}

// The payloads of the clip's KLV stream, joined.
std::string klv_payloads() {
  const auto streams = data_streams_of(klv_clip());
  REQUIRE(streams);
  std::string bytes;
  for (const DataStream& stream : *streams) {
    if (!is_klv_stream(stream)) continue;
    const auto payloads = read_data_stream(klv_clip(), stream.index);
    REQUIRE(payloads);
    for (const DataPacket& payload : payloads->packets) bytes += payload.bytes;
  }
  return bytes;
}

const std::string kUasKey("\x06\x0E\x2B\x34\x02\x0B\x01\x01\x0E\x01\x03\x01\x01\x00\x00\x00", 16);

std::string klv_item(unsigned tag, const std::string& value) {
  return std::string{static_cast<char>(tag), static_cast<char>(value.size())} + value;
}

// A packet with a checksum, added up as the standard's example in C does: pairs of bytes.
std::string klv_packet_of(const std::string& items) {
  std::string packet =
      kUasKey + std::string{static_cast<char>(0x81), static_cast<char>(items.size() + 4)} + items + "\x01\x02";
  unsigned sum = 0;
  for (std::size_t i = 0; i < packet.size(); ++i)
    sum = (sum + (static_cast<unsigned char>(packet[i]) << (8 * ((i + 1) % 2)))) % 65536;
  return packet + static_cast<char>(sum / 256) + static_cast<char>(sum % 256);
}

std::string klv_stamp(char last) {
  return klv_item(2, std::string("\x00\x05\x50\x00\x00\x00\x00", 7) + last);
}

}  // namespace

TEST_CASE("every packet of the clip is what another decoder makes of it") {
  if (!has_real_data()) return;
  std::ifstream in(klv_clip().parent_path() / "h264_klv_decoded_by_us.json");
  std::string json{std::istreambuf_iterator<char>(in), {}};
  const KlvPackets read = klv_packets(klv_payloads());
  CHECK(read.bad_checksums + read.broken + read.skipped_bytes == 0);
  REQUIRE(read.packets.size() == 30);
  std::size_t at = 0;
  // The JSON has the fields in this order in each packet.
  const auto next = [&](const std::string& key) {
    at = json.find("\"" + key + "\":", at);
    REQUIRE(at != std::string::npos);
    return std::strtod(json.c_str() + at + key.size() + 3, nullptr);
  };
  for (const KlvPacket& packet : read.packets) {
    CHECK(packet.has_checksum);
    const auto same = [&](const std::optional<double>& value, const char* key) {
      const double expected = next(key);
      REQUIRE(value);
      CHECK(*value == doctest::Approx(expected).epsilon(1e-12));
    };
    CHECK(*packet.unix_s * 1e6 == doctest::Approx(next("unix_us")).epsilon(1e-15));
    same(packet.platform_heading_deg, "platform_heading_deg");
    same(packet.platform_pitch_deg, "platform_pitch_deg");
    same(packet.platform_roll_deg, "platform_roll_deg");
    same(packet.sensor_latitude_deg, "sensor_lat_deg");
    same(packet.sensor_longitude_deg, "sensor_lon_deg");
    same(packet.sensor_altitude_m, "sensor_alt_m");
    same(packet.horizontal_fov_deg, "hfov_deg");
    same(packet.vertical_fov_deg, "vfov_deg");
    same(packet.sensor_azimuth_deg, "sensor_rel_az_deg");
    same(packet.sensor_elevation_deg, "sensor_rel_el_deg");
    same(packet.sensor_roll_deg, "sensor_rel_roll_deg");
    same(packet.slant_range_m, "slant_range_m");
    same(packet.frame_center_latitude_deg, "frame_center_lat_deg");
    same(packet.frame_center_longitude_deg, "frame_center_lon_deg");
    same(packet.frame_center_elevation_m, "frame_center_elev_m");
  }
}

TEST_CASE("the clip's track has all packets at the times of their own stamps") {
  if (!has_real_data()) return;
  const Result<Track> track = read_track(klv_clip());
  REQUIRE(track);
  CHECK(track->format == "MISB ST 0601");
  CHECK(track->position.values.size() == 30);
  CHECK(track->height_above_ellipsoid);
  CHECK(!track->on_footage_time);  // the stream's packets have no presentation times
  CHECK(*track->utc_at_zero_s == doctest::Approx(1224807209.913).epsilon(1e-15));
  CHECK(track->position.times_s[1] == doctest::Approx(0.033333).epsilon(1e-5));
  CHECK(is_in_order(*track));
}

TEST_CASE("the camera of ST 0601 is turned on the platform: azimuth, elevation, roll") {
  // A platform that flies east and level, with a sensor 90 degrees to its right and 30 degrees down: it looks south.
  // 0x40000000 of 2^32 - 1 is 90 degrees, 0x4000 of 2^16 - 1 too, -30 / 180 of 2^31 - 1 is EAAAAAAB.
  const std::string packet =
      klv_packet_of(klv_stamp('\x00') + klv_item(5, std::string("\x40\x00", 2)) + klv_item(6, std::string(2, '\0')) +
                    klv_item(7, std::string(2, '\0')) + klv_item(18, std::string("\x40\x00\x00\x00", 4)) +
                    klv_item(19, "\xEA\xAA\xAA\xAB") + klv_item(20, std::string(4, '\0')));
  const KlvPackets read = klv_packets(packet);
  REQUIRE(read.packets.size() == 1);
  const Result<Track> track = klv_track({{.packet = read.packets[0]}}, "made");
  REQUIRE(track);
  REQUIRE(track->ned_from_camera.values.size() == 1);
  const glm::dvec3 axis = track->ned_from_camera.values[0] * glm::dvec3(1, 0, 0);
  CHECK(axis.x == doctest::Approx(-std::cos(rad_of_deg(30))).epsilon(1e-4));  // a step of tag 5 is 0.005 degrees
  CHECK(std::abs(axis.y) < 2e-4);
  CHECK(axis.z == doctest::Approx(0.5).epsilon(1e-4));
  CHECK(glm::length(track->ned_from_airframe.values[0] * glm::dvec3(1, 0, 0) - glm::dvec3(0, 1, 0)) < 2e-4);
}

TEST_CASE("numbers that the standard reserves for errors are left out") {
  const KlvPackets read = klv_packets(klv_packet_of(
      klv_stamp('\x00') + klv_item(6, std::string("\x80\x00", 2)) + klv_item(13, std::string("\x80\x00\x00\x00", 4)) +
      klv_item(14, "\x40") + klv_item(104, std::string("\xC8\x00\x00", 3)) + klv_item(5, "\xFF\xFF")));
  REQUIRE(read.packets.size() == 1);
  CHECK(!read.packets[0].platform_pitch_deg);
  CHECK(!read.packets[0].sensor_latitude_deg);
  CHECK(!read.packets[0].sensor_longitude_deg);            // one byte where the standard has four
  CHECK(!read.packets[0].sensor_full_ellipsoid_height_m);  // infinity in ST 1201
  CHECK(*read.packets[0].platform_heading_deg == 360);
}

TEST_CASE("ST 1201's number is low plus steps of a power of two") {
  // Three bytes, -900..40000 m: bits for the range: ceil(log2(40900)) = 16, so a step is 2^(16 - 23) = 1/128 m.
  const KlvPackets read = klv_packets(klv_packet_of(klv_item(104, std::string("\x2F\x92\x1E", 3))));
  REQUIRE(read.packets.size() == 1);
  CHECK(*read.packets[0].sensor_full_ellipsoid_height_m == 0x2F921E / 128.0 - 900);
}

TEST_CASE("a packet whose checksum is wrong is left out, others around it are read") {
  const std::string good = klv_packet_of(klv_stamp('\x00') + klv_item(5, std::string(2, '\0')) +
                                         klv_item(6, std::string(2, '\0')) + klv_item(7, std::string(2, '\0')));
  std::string bad = good;
  bad[25] ^= 1;
  const KlvPackets read = klv_packets(good + bad + "noise" + good + good.substr(0, 30));
  CHECK(read.packets.size() == 2);
  CHECK(read.bad_checksums == 1);
  CHECK(read.skipped_bytes > 0);
  CHECK(read.cut_off);

  TemporaryFolder folder;
  write_file(folder / "bare.klv", good + bad + good);
  const Result<Track> track = read_track(folder / "bare.klv");
  REQUIRE(track);
  CHECK(track->damaged);
  CHECK(warnings_with(*track, "1 packet left out: the checksum is wrong") == 1);
}

TEST_CASE("a file with a key every 20 bytes is not read over and over") {
  std::string hostile;
  while (hostile.size() < 2'000'000) hostile += kUasKey + std::string("\x82\xEA\x60\x63", 4);  // 60,000 bytes each
  const std::string good = klv_packet_of(klv_stamp('\x01'));
  KlvPackets read = klv_packets(good + hostile + good);
  CHECK(read.packets.size() >= 1);
  CHECK(read.bytes_reread < 2 * hostile.size());
  // Damage of a common size costs no packet: lengths that are wrong hide none of the packets behind them.
  std::string file;
  for (int i = 0; i < 200; ++i) {
    std::string bad = good;
    bad[16] = '\x7F';
    file += i % 4 == 3 ? bad : good;
  }
  read = klv_packets(file + good + good);
  CHECK(read.packets.size() == 152);
}

TEST_CASE("synchronous KLV has a header before each packet that is passed over") {
  const std::string packet = klv_packet_of(klv_stamp('\x01'));
  const std::string header = std::string("\x00\x01\xDF\x00", 4) + static_cast<char>(packet.size());
  const KlvPackets read = klv_packets(header + packet + header + packet);
  CHECK(read.packets.size() == 2);
  CHECK(read.skipped_bytes == 0);
}

TEST_CASE("broken KLV never reads beyond its bytes") {
  const auto read = [](std::string_view broken) {
    std::vector<TimedKlvPacket> packets;
    for (const KlvPacket& packet : klv_packets(broken).packets) packets.push_back({.packet = packet});
    return klv_track(packets, "broken.klv");
  };
  const std::string giant = kUasKey + std::string("\x88\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF", 9) + "x";
  CHECK(!read(giant));
  CHECK(klv_packets(kUasKey + "\x84\x7F\xFF\xFF\xFF").packets.empty());
  if (!has_real_data()) return;
  const std::string bytes = klv_payloads();
  CHECK(survives(bytes, read, 300, 300, bytes.size()));
}

TEST_CASE("with presentation times the track is on the footage's axis, and the stamps give its UTC") {
  const std::string items =
      klv_item(5, std::string(2, '\0')) + klv_item(6, std::string(2, '\0')) + klv_item(7, std::string(2, '\0'));
  const KlvPackets read =
      klv_packets(klv_packet_of(klv_stamp('\x00') + items) + klv_packet_of(klv_stamp('\x40') + items));
  REQUIRE(read.packets.size() == 2);
  const Result<Track> track =
      klv_track({{.packet = read.packets[0], .footage_s = 0.5}, {.packet = read.packets[1], .footage_s = 0.6}}, "made");
  REQUIRE(track);
  CHECK(track->on_footage_time);
  CHECK(track->ned_from_airframe.times_s == std::vector<double>{0.5, 0.6});
  // 0x0005500000000000 microseconds at 0.5 s of the footage.
  CHECK(*track->utc_at_zero_s == doctest::Approx(0x0005500000000000 * 1e-6 - 0.5).epsilon(1e-14));
}

TEST_CASE("a packet whose stamp is far off is left out alone, the first too") {
  const std::string items =
      klv_item(5, std::string(2, '\0')) + klv_item(6, std::string(2, '\0')) + klv_item(7, std::string(2, '\0'));
  for (const std::size_t wrong : {std::size_t{0}, std::size_t{4}, std::size_t{19}}) {
    CAPTURE(wrong);
    std::vector<TimedKlvPacket> packets;
    for (std::size_t i = 0; i < 20; ++i) {
      packets.push_back({.packet = klv_packets(klv_packet_of(klv_stamp('\x00') + items)).packets.at(0)});
      packets.back().packet.unix_s = 1.6e9 + 0.04 * static_cast<double>(i) + (i == wrong ? 1e6 : 0);
    }
    const Result<Track> track = klv_track(packets, "made");
    REQUIRE(track);
    CHECK(track->ned_from_airframe.values.size() == 19);
    CHECK(*track->utc_at_zero_s == doctest::Approx(wrong == 0 ? 1.6e9 + 0.04 : 1.6e9).epsilon(1e-15));
    CHECK(track->ned_from_airframe.times_s.front() == doctest::Approx(0));
    CHECK(warnings_with(*track, "1 sample left out") == 1);
  }
}
