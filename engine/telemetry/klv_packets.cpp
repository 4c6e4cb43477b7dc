// SPDX-License-Identifier: MIT
#include "telemetry/klv_packets.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "telemetry/binary_numbers.h"
#include "telemetry/log_formats.h"

namespace sigs {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kKey = "\x06\x0E\x2B\x34\x02\x0B\x01\x01\x0E\x01\x03\x01\x01\x00\x00\x00"sv;
constexpr std::string_view kAnyKey = "\x06\x0E\x2B\x34"sv;  // of all keys that SMPTE registers
constexpr std::size_t kAccessUnitHeader_bytes = 5;
constexpr std::size_t kReread_bytes = std::size_t{1} << 20;
constexpr std::size_t kMaxPacket_bytes = 65536;  // real ones have up to some 2000; a longer one is a damaged length

// How a number is stored (ST 0601, section 8, and ST 1201 for the last).
enum class Coding {
  unsigned_range,  // 0 is low, all bits set is high
  signed_range,    // from low to high, symmetric about 0; the most negative number is "error"
  imapb,           // ST 1201: steps of a power of 2 from low on; the highest bit is 0 for ordinary numbers
};

struct Item {
  unsigned tag = 0;
  std::size_t bytes = 0;  // 0: any number up to 8
  Coding coding = Coding::unsigned_range;
  double low = 0;
  double high = 0;
  std::optional<double> KlvPacket::*field = nullptr;
};

constexpr std::array<Item, 20> kItems{{
    {5, 2, Coding::unsigned_range, 0, 360, &KlvPacket::platform_heading_deg},
    {6, 2, Coding::signed_range, -20, 20, &KlvPacket::platform_pitch_deg},
    {90, 4, Coding::signed_range, -90, 90, &KlvPacket::platform_full_pitch_deg},
    {7, 2, Coding::signed_range, -50, 50, &KlvPacket::platform_roll_deg},
    {91, 4, Coding::signed_range, -90, 90, &KlvPacket::platform_full_roll_deg},
    {13, 4, Coding::signed_range, -90, 90, &KlvPacket::sensor_latitude_deg},
    {14, 4, Coding::signed_range, -180, 180, &KlvPacket::sensor_longitude_deg},
    {15, 2, Coding::unsigned_range, -900, 19000, &KlvPacket::sensor_altitude_m},
    {75, 2, Coding::unsigned_range, -900, 19000, &KlvPacket::sensor_ellipsoid_height_m},
    {104, 0, Coding::imapb, -900, 40000, &KlvPacket::sensor_full_ellipsoid_height_m},
    {16, 2, Coding::unsigned_range, 0, 180, &KlvPacket::horizontal_fov_deg},
    {17, 2, Coding::unsigned_range, 0, 180, &KlvPacket::vertical_fov_deg},
    {18, 4, Coding::unsigned_range, 0, 360, &KlvPacket::sensor_azimuth_deg},
    {19, 4, Coding::signed_range, -180, 180, &KlvPacket::sensor_elevation_deg},
    {20, 4, Coding::unsigned_range, 0, 360, &KlvPacket::sensor_roll_deg},
    {21, 4, Coding::unsigned_range, 0, 5e6, &KlvPacket::slant_range_m},
    {22, 2, Coding::unsigned_range, 0, 10000, &KlvPacket::target_width_m},
    {23, 4, Coding::signed_range, -90, 90, &KlvPacket::frame_center_latitude_deg},
    {24, 4, Coding::signed_range, -180, 180, &KlvPacket::frame_center_longitude_deg},
    {25, 2, Coding::unsigned_range, -900, 19000, &KlvPacket::frame_center_elevation_m},
}};

// ST 1201, equations for IMAPB of `bytes` bytes. Numbers with the highest bit set are infinities, NaN and the like.
std::optional<double> imapb(std::uint64_t number, std::size_t bytes, double low, double high) {
  const int bits = static_cast<int>(8 * bytes);
  if (number >> (bits - 1) != 0) return {};
  const double steps_per_unit = std::exp2(bits - 1 - std::ceil(std::log2(high - low)));
  const double offset = low < 0 && high > 0 ? steps_per_unit * low - std::floor(steps_per_unit * low) : 0;
  return (static_cast<double>(number) - offset) / steps_per_unit + low;
}

std::optional<double> decoded(const Item& item, std::string_view value) {
  if (value.empty() || value.size() > 8 || (item.bytes != 0 && value.size() != item.bytes)) return {};
  const std::uint64_t number = big_endian(value);
  if (item.coding == Coding::imapb) return imapb(number, value.size(), item.low, item.high);
  const double full = std::exp2(static_cast<double>(8 * value.size()));
  if (item.coding == Coding::unsigned_range)
    return item.low + (item.high - item.low) * static_cast<double>(number) / (full - 1);
  const double half = full / 2;
  const double with_sign =
      static_cast<double>(number) < half ? static_cast<double>(number) : static_cast<double>(number) - full;
  if (with_sign == -half) return {};
  return item.high * with_sign / (half - 1);
}

// Takes a length (BER, ISO/IEC 8825-1) off the bytes: below 128 itself, else the number of bytes that have it. Nothing
// where it does not fit or makes no sense.
std::optional<std::uint64_t> taken_length(std::string_view& bytes) {
  if (bytes.empty()) return {};
  const unsigned first = static_cast<unsigned char>(bytes.front());
  bytes.remove_prefix(1);
  if (first < 128) return first;
  const std::size_t count = first & 127U;
  if (count == 0 || count > 8 || count > bytes.size()) return {};
  const std::uint64_t length = big_endian(bytes.substr(0, count));
  bytes.remove_prefix(count);
  return length;
}

// Takes a tag (BER-OID: 7 bits a byte, the highest bit set in all but the last) off the bytes.
std::optional<unsigned> taken_tag(std::string_view& bytes) {
  unsigned tag = 0;
  for (int i = 0; i < 4 && !bytes.empty(); ++i) {
    const unsigned byte = static_cast<unsigned char>(bytes.front());
    bytes.remove_prefix(1);
    tag = tag << 7 | (byte & 127U);
    if (byte < 128) return tag;
  }
  return {};
}

// The running 16-bit sum of ST 0601: bytes at even places count 256 times.
unsigned checksum_of(std::string_view bytes) {
  unsigned sum = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    sum += static_cast<unsigned>(static_cast<unsigned char>(bytes[i])) << (i % 2 == 0 ? 8 : 0);
  return sum & 0xFFFFU;
}

std::string printable(std::string_view text) {
  std::string shown;
  for (const char c : text.substr(0, 127))
    if (c >= ' ' && c <= '~') shown += c;
  return shown;
}

enum class Verdict { good, bad_checksum, broken };

// The items of one packet.
//   whole  from its key on
Verdict read_items(std::string_view items, std::string_view whole, KlvPacket& packet) {
  std::array<std::string_view, kItems.size()> values;
  while (!items.empty()) {
    const std::optional<unsigned> tag = taken_tag(items);
    const std::optional<std::uint64_t> length = tag ? taken_length(items) : std::nullopt;
    if (!length || *length > items.size()) return Verdict::broken;
    const std::string_view value = items.substr(0, *length);
    items.remove_prefix(*length);
    if (*tag == 1 && value.size() == 2) {
      const std::size_t summed = static_cast<std::size_t>(value.data() - whole.data());
      if (checksum_of(whole.substr(0, summed)) != big_endian(value)) return Verdict::bad_checksum;
      packet.has_checksum = true;
    }
    if (*tag == 2 && value.size() == 8) packet.unix_s = static_cast<double>(big_endian(value)) * 1e-6;
    if (*tag == 10) packet.platform = printable(value);
    if (*tag == 11) packet.sensor = printable(value);
    for (std::size_t i = 0; i < kItems.size(); ++i)
      if (kItems[i].tag == *tag) values[i] = value;
  }
  for (std::size_t i = 0; i < kItems.size(); ++i)
    if (const std::optional<double> number = decoded(kItems[i], values[i])) packet.*kItems[i].field = number;
  return Verdict::good;
}

// Number of the bytes before the next key that are not the header of its access unit. That header ends with the length
// of the packet, which follows.
std::size_t strange_bytes(std::string_view before, std::size_t packet_bytes) {
  if (before.size() < kAccessUnitHeader_bytes) return before.size();
  const bool is_header = big_endian(before.substr(before.size() - 2)) == packet_bytes;
  return before.size() - (is_header ? kAccessUnitHeader_bytes : 0);
}

}  // namespace

bool is_klv(std::string_view head) {
  // Not a container that has KLV in it: there the packets are cut into pieces.
  return head.substr(0, 64).find(kAnyKey) != std::string_view::npos && head.find(kKey) != std::string_view::npos &&
         !head.starts_with('G');
}

KlvPackets klv_packets(std::string_view bytes) {
  KlvPackets read;
  std::size_t at = 0;
  while (at < bytes.size()) {
    const std::size_t key = std::min(bytes.find(kAnyKey, at), bytes.size());
    std::string_view rest = bytes.substr(key);
    const bool is_whole_key = rest.size() >= kKey.size();
    rest.remove_prefix(std::min(kKey.size(), rest.size()));
    const std::optional<std::uint64_t> length = is_whole_key ? taken_length(rest) : std::nullopt;
    const bool fits = length && *length <= rest.size() && *length <= kMaxPacket_bytes;
    const std::size_t items = bytes.size() - rest.size();
    read.skipped_bytes += strange_bytes(bytes.substr(at, key - at), fits ? items - key + *length : 0);
    if (!fits) {
      // A length that was damaged must not swallow the packets behind it.
      read.cut_off |= key < bytes.size();
      at = std::min(key + kAnyKey.size(), bytes.size());
      continue;
    }
    at = items + *length;
    if (bytes.substr(key, kKey.size()) != kKey) continue;
    KlvPacket packet{.offset = key};
    const Verdict verdict = read_items(bytes.substr(items, *length), bytes.substr(key, at - key), packet);
    read.bad_checksums += verdict == Verdict::bad_checksum ? 1 : 0;
    read.broken += verdict == Verdict::broken ? 1 : 0;
    if (verdict == Verdict::good) {
      read.packets.push_back(std::move(packet));
    } else if (read.bytes_reread < bytes.size() + kReread_bytes) {
      read.bytes_reread += *length;
      at = key + kKey.size();  // its length may be what was damaged
    }
  }
  return read;
}

}  // namespace sigs
