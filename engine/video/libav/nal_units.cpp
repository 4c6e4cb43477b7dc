// SPDX-License-Identifier: MIT
#include "video/libav/nal_units.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace sigs::libav {
namespace {

// H.264, table 7-1; H.265, table 7-1.
namespace h264 {
constexpr int kIdr = 5, kSei = 6, kSps = 7, kPps = 8, kDelimiter = 9, kFiller = 12;
}
namespace hevc {
constexpr int kBla = 16, kBlaAlone = 18, kIdrLast = 20, kCra = 21, kLastKey = 23, kVps = 32, kSps = 33, kPps = 34,
              kDelimiter = 35, kSuffixSei = 40;
}

int type_of(ByteSpan unit, AVCodecID codec) {
  if (unit.empty()) return -1;
  return codec == AV_CODEC_ID_H264 ? unit[0] & 31 : unit[0] >> 1 & 63;
}

// Bytes without those that keep start codes from appearing by chance (H.264, 7.4.1).
Bytes without_emulation_prevention(ByteSpan unit) {
  Bytes plain;
  plain.reserve(unit.size());
  int zeros = 0;
  for (const std::uint8_t byte : unit) {
    if (zeros >= 2 && byte == 3) {
      zeros = 0;
      continue;
    }
    plain.push_back(byte);
    zeros = byte == 0 ? zeros + 1 : 0;
  }
  return plain;
}

Bytes with_emulation_prevention(const Bytes& plain) {
  Bytes unit;
  unit.reserve(plain.size() + plain.size() / 64);
  int zeros = 0;
  for (const std::uint8_t byte : plain) {
    if (zeros >= 2 && byte <= 3) {
      unit.push_back(3);
      zeros = 0;
    }
    unit.push_back(byte);
    zeros = byte == 0 ? zeros + 1 : 0;
  }
  if (zeros > 0) unit.push_back(3);  // no unit ends with a zero
  return unit;
}

// Reads bits of plain bytes from the most significant on; zeros beyond their end.
class BitReader {
 public:
  explicit BitReader(const Bytes& bytes, std::size_t bit = 0) : bytes_(bytes), bit_(bit) {}

  [[nodiscard]] std::size_t at() const { return bit_; }
  void skip(std::size_t bits) { bit_ += bits; }

  unsigned read(int bits) {
    unsigned value = 0;
    for (int i = 0; i < bits; ++i, ++bit_) {
      const std::size_t byte = bit_ / 8;
      value = value << 1 | (byte < bytes_.size() ? bytes_[byte] >> (7 - bit_ % 8) & 1U : 0U);
    }
    return value;
  }

  // Exp-Golomb code (H.264, 9.1).
  int read_code() {
    int zeros = 0;
    while (zeros < 31 && bit_ < 8 * bytes_.size() && read(1) == 0) ++zeros;
    return static_cast<int>((1U << zeros) - 1 + read(zeros));
  }

 private:
  const Bytes& bytes_;
  std::size_t bit_;
};

class BitWriter {
 public:
  void write(unsigned value, int bits) {
    for (int i = bits - 1; i >= 0; --i) {
      if (bit_ % 8 == 0) bytes_.push_back(0);
      bytes_.back() = static_cast<std::uint8_t>(bytes_.back() | (value >> i & 1U) << (7 - bit_ % 8));
      ++bit_;
    }
  }

  void write_code(int value) {
    int length = 0;
    while ((value + 1) >> (length + 1) != 0) ++length;
    write(0, length);
    write(static_cast<unsigned>(value + 1), length + 1);
  }

  void copy(BitReader& from, std::size_t end) {
    while (from.at() < end) {
      const std::size_t left = end - from.at();
      const int bits = static_cast<int>(std::min<std::size_t>(left, 8));
      write(from.read(bits), bits);
    }
  }

  [[nodiscard]] Bytes take() { return std::move(bytes_); }

 private:
  Bytes bytes_;
  std::size_t bit_ = 0;
};

// Where the content of a parameter set ends: at the last bit that is 1 (rbsp_stop_one_bit), which is not part of it.
std::size_t end_of_content(const Bytes& plain) {
  std::size_t end = plain.size();
  while (end > 0 && plain[end - 1] == 0) --end;
  if (end == 0) return 0;
  std::size_t bit = 8 * end - 1;
  while ((plain[bit / 8] >> (7 - bit % 8) & 1) == 0) --bit;
  return bit;
}

// The bits of HEVC's profile_tier_level (H.265, 7.3.3) behind the general part's flags.
void skip_profile_tier_level(BitReader& bits, unsigned sub_layers_minus1) {
  bits.skip(96);
  if (sub_layers_minus1 == 0) return;
  std::size_t more = 0;
  for (unsigned i = 0; i < sub_layers_minus1; ++i)
    more += (bits.read(1) != 0 ? 88U : 0U) + (bits.read(1) != 0 ? 8U : 0U);
  bits.skip(2U * (8U - sub_layers_minus1) + more);
}

// A BitReader before the number of a sequence parameter set.
BitReader before_sequence_id(const Bytes& plain, AVCodecID codec) {
  if (codec == AV_CODEC_ID_H264) return BitReader(plain, 32);
  BitReader bits(plain, 20);
  const unsigned sub_layers_minus1 = bits.read(3);
  bits.skip(1);
  skip_profile_tier_level(bits, sub_layers_minus1);
  return bits;
}

// general_level_idc is the byte at `at`.
void raise_level(Bytes& plain, std::size_t at, int level) {
  if (at < plain.size()) plain[at] = static_cast<std::uint8_t>(std::clamp(level, int{plain[at]}, 255));
}

Bytes renumbered_sequence(const Bytes& plain, const HevcNumbers& numbers) {
  BitReader in(plain);
  BitWriter out;
  out.copy(in, 16);
  out.write(static_cast<unsigned>(numbers.video), 4);
  in.skip(4);
  out.copy(in, before_sequence_id(plain, AV_CODEC_ID_HEVC).at());
  static_cast<void>(in.read_code());
  out.write_code(numbers.sequence);
  out.copy(in, end_of_content(plain));
  out.write(1, 1);
  return out.take();
}

Bytes renumbered_picture_set(const Bytes& plain, const HevcNumbers& numbers) {
  BitReader in(plain);
  BitWriter out;
  out.copy(in, 16);
  static_cast<void>(in.read_code());
  static_cast<void>(in.read_code());
  out.write_code(numbers.picture);
  out.write_code(numbers.sequence);
  out.copy(in, end_of_content(plain));
  out.write(1, 1);
  return out.take();
}

Bytes renumbered_slice(const Bytes& plain, int type, const HevcNumbers& numbers) {
  BitReader in(plain);
  BitWriter out;
  const bool is_key = type >= hevc::kBla && type <= hevc::kLastKey;
  out.copy(in, is_key ? 18 : 17);
  static_cast<void>(in.read_code());
  out.write_code(numbers.picture);
  out.copy(in, 8 * plain.size());
  return out.take();
}

std::size_t read_length(ByteSpan bytes, int length_bytes) {
  std::size_t length = 0;
  for (int i = 0; i < length_bytes; ++i) length = length << 8 | bytes[static_cast<std::size_t>(i)];
  return length;
}

std::vector<ByteSpan> units_after_start_codes(ByteSpan packet) {
  std::vector<ByteSpan> units;
  std::optional<std::size_t> begin;
  const auto close = [&](std::size_t end) {
    while (begin && end > *begin && packet[end - 1] == 0) --end;  // zeros before a start code belong to it
    if (begin && end > *begin) units.push_back(packet.subspan(*begin, end - *begin));
  };
  for (std::size_t i = 0; i + 3 <= packet.size(); ++i) {
    if (packet[i] != 0 || packet[i + 1] != 0 || packet[i + 2] != 1) continue;
    close(i);
    begin = i + 3;
    i += 2;
  }
  close(packet.size());
  return units;
}

ByteSpan stream_header(const AVCodecParameters& stream) {
  if (stream.extradata == nullptr || stream.extradata_size <= 0) return {};
  return {stream.extradata, static_cast<std::size_t>(stream.extradata_size)};
}

// Appends `count` units with lengths of 16 bits; the place behind them.
std::size_t take_units(ByteSpan header, std::size_t at, int count, std::vector<ByteSpan>& units) {
  for (int i = 0; i < count && at + 2 <= header.size(); ++i) {
    const std::size_t length = read_length(header.subspan(at), 2);
    if (at + 2 + length > header.size()) return header.size();
    units.push_back(header.subspan(at + 2, length));
    at += 2 + length;
  }
  return at;
}

void append_with_16_bits(Bytes& header, ByteSpan unit) {
  header.push_back(static_cast<std::uint8_t>(unit.size() >> 8));
  header.push_back(static_cast<std::uint8_t>(unit.size()));
  header.insert(header.end(), unit.begin(), unit.end());
}

// avcC (ISO/IEC 14496-15, 5.3.3.1): numbers of sequence and picture parameter sets in 5 and 8 bits.
Bytes extended_avcc(ByteSpan header, const std::vector<Bytes>& more) {
  std::vector<ByteSpan> sets;
  const int sequences = header[5] & 31;
  std::size_t at = take_units(header, 6, sequences, sets);
  if (at >= header.size()) return {};
  Bytes out(header.begin(), header.begin() + static_cast<std::ptrdiff_t>(at));
  const auto count_of = [&more](int type) {
    return static_cast<int>(std::count_if(
        more.begin(), more.end(), [type](const Bytes& unit) { return type_of(unit, AV_CODEC_ID_H264) == type; }));
  };
  const int pictures = header[at];
  if (sequences + count_of(h264::kSps) > 31 || pictures + count_of(h264::kPps) > 255) return {};
  out[5] = static_cast<std::uint8_t>(header[5] + count_of(h264::kSps));
  for (const Bytes& unit : more)
    if (type_of(unit, AV_CODEC_ID_H264) == h264::kSps) append_with_16_bits(out, unit);
  const std::size_t end = take_units(header, at + 1, pictures, sets);
  out.push_back(static_cast<std::uint8_t>(pictures + count_of(h264::kPps)));
  out.insert(out.end(), header.begin() + static_cast<std::ptrdiff_t>(at) + 1,
             header.begin() + static_cast<std::ptrdiff_t>(end));
  for (const Bytes& unit : more)
    if (type_of(unit, AV_CODEC_ID_H264) == h264::kPps) append_with_16_bits(out, unit);
  out.insert(out.end(), header.begin() + static_cast<std::ptrdiff_t>(end), header.end());
  return out;
}

// hvcC (ISO/IEC 14496-15, 8.3.3.1): arrays of units of one type each; several arrays of a type are allowed.
Bytes extended_hvcc(ByteSpan header, const std::vector<Bytes>& more) {
  if (header[22] + more.size() > 255) return {};
  Bytes out(header.begin(), header.end());
  out[22] = static_cast<std::uint8_t>(header[22] + more.size());
  for (const Bytes& unit : more) {
    out.push_back(static_cast<std::uint8_t>(0x80 | type_of(unit, AV_CODEC_ID_HEVC)));  // complete, of this type
    out.push_back(0);
    out.push_back(1);
    append_with_16_bits(out, unit);
  }
  return out;
}

constexpr std::size_t kShortestAvcc = 7;
constexpr std::size_t kShortestHvcc = 23;

bool has_lengths(ByteSpan header, AVCodecID codec) {
  return header.size() >= (codec == AV_CODEC_ID_H264 ? kShortestAvcc : kShortestHvcc) && header[0] == 1;
}

}  // namespace

int nal_length_bytes(const AVCodecParameters& stream) {
  const ByteSpan header = stream_header(stream);
  if (!has_lengths(header, stream.codec_id)) return 0;
  return (header[stream.codec_id == AV_CODEC_ID_H264 ? 4 : 21] & 3) + 1;
}

std::vector<ByteSpan> nal_units_of(ByteSpan packet, int length_bytes) {
  if (length_bytes == 0) return units_after_start_codes(packet);
  const auto prefix = static_cast<std::size_t>(length_bytes);
  std::vector<ByteSpan> units;
  while (packet.size() > prefix) {
    const std::size_t length = read_length(packet, length_bytes);
    if (length > packet.size() - prefix) break;
    units.push_back(packet.subspan(prefix, length));
    packet = packet.subspan(prefix + length);
  }
  return units;
}

void append_nal(Bytes& packet, ByteSpan unit, int length_bytes) {
  if (length_bytes == 0) packet.insert(packet.end(), {0, 0, 0, 1});
  for (int i = length_bytes - 1; i >= 0; --i) packet.push_back(static_cast<std::uint8_t>(unit.size() >> (8 * i)));
  packet.insert(packet.end(), unit.begin(), unit.end());
}

KeyKind key_kind_of(ByteSpan packet, AVCodecID codec, int length_bytes) {
  for (const ByteSpan unit : nal_units_of(packet, length_bytes)) {
    const int type = type_of(unit, codec);
    if (codec == AV_CODEC_ID_H264 && type == h264::kIdr) return KeyKind::refresh;
    if (codec != AV_CODEC_ID_HEVC) continue;
    if (type >= hevc::kBla && type <= hevc::kIdrLast) return KeyKind::refresh;
    if (type == hevc::kCra) return KeyKind::open_group;
  }
  return KeyKind::none;
}

std::vector<ByteSpan> parameter_sets_in(const AVCodecParameters& stream) {
  const ByteSpan header = stream_header(stream);
  if (!has_lengths(header, stream.codec_id)) return units_after_start_codes(header);
  std::vector<ByteSpan> units;
  if (stream.codec_id == AV_CODEC_ID_H264) {
    const std::size_t at = take_units(header, 6, header[5] & 31, units);
    if (at < header.size()) take_units(header, at + 1, header[at], units);
    return units;
  }
  std::size_t at = kShortestHvcc;
  for (int array = 0; array < header[22] && at + 3 <= header.size(); ++array)
    at = take_units(header, at + 3, static_cast<int>(read_length(header.subspan(at + 1), 2)), units);
  return units;
}

ParameterSetIds ids_of(const std::vector<ByteSpan>& parameter_sets, AVCodecID codec) {
  ParameterSetIds ids;
  const bool is_h264 = codec == AV_CODEC_ID_H264;
  for (const ByteSpan unit : parameter_sets) {
    const int type = type_of(unit, codec);
    const Bytes plain = without_emulation_prevention(unit);
    if (!is_h264 && type == hevc::kVps) ids.video.insert(static_cast<int>(BitReader(plain, 16).read(4)));
    if (type == (is_h264 ? h264::kSps : hevc::kSps)) ids.sequence.insert(before_sequence_id(plain, codec).read_code());
    if (type == (is_h264 ? h264::kPps : hevc::kPps)) ids.picture.insert(BitReader(plain, is_h264 ? 8 : 16).read_code());
  }
  return ids;
}

Bytes with_parameter_sets(const AVCodecParameters& stream, const std::vector<Bytes>& more) {
  const ByteSpan header = stream_header(stream);
  if (has_lengths(header, stream.codec_id))
    return stream.codec_id == AV_CODEC_ID_H264 ? extended_avcc(header, more) : extended_hvcc(header, more);
  Bytes out(header.begin(), header.end());
  for (const Bytes& unit : more) append_nal(out, unit, 0);
  return out;
}

bool is_dispensable(ByteSpan unit, AVCodecID codec) {
  const int type = type_of(unit, codec);
  if (codec == AV_CODEC_ID_H264)
    return type == h264::kSei || (type >= h264::kDelimiter && type <= h264::kFiller) || type < 0;
  return (type >= hevc::kDelimiter && type <= hevc::kSuffixSei) || type < 0;
}

bool is_parameter_set(ByteSpan unit, AVCodecID codec) {
  const int type = type_of(unit, codec);
  if (codec == AV_CODEC_ID_H264) return type == h264::kSps || type == h264::kPps;
  return type >= hevc::kVps && type <= hevc::kPps;
}

void break_links(std::span<std::uint8_t> packet, int length_bytes) {
  for (const ByteSpan unit : nal_units_of(packet, length_bytes)) {
    if (type_of(unit, AV_CODEC_ID_HEVC) != hevc::kCra) continue;
    std::uint8_t& first = packet[static_cast<std::size_t>(unit.data() - packet.data())];
    first = static_cast<std::uint8_t>((first & 0x81) | hevc::kBlaAlone << 1);
  }
}

Bytes renumbered(ByteSpan unit, const HevcNumbers& numbers) {
  const int type = type_of(unit, AV_CODEC_ID_HEVC);
  Bytes plain = without_emulation_prevention(unit);
  if (type == hevc::kVps && plain.size() > 2)
    plain[2] = static_cast<std::uint8_t>((plain[2] & 15) | numbers.video << 4);
  if (type == hevc::kVps) raise_level(plain, 17, numbers.level);
  if (type == hevc::kSps) raise_level(plain, 14, numbers.level);
  if (type == hevc::kSps) plain = renumbered_sequence(plain, numbers);
  if (type == hevc::kPps) plain = renumbered_picture_set(plain, numbers);
  if (type >= 0 && type < hevc::kVps) plain = renumbered_slice(plain, type, numbers);
  return with_emulation_prevention(plain);
}

}  // namespace sigs::libav
