// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "video/libav/handles.h"

namespace sigs::libav {

// The units of a stream of H.264 (ITU-T H.264, 7.3) or HEVC (ITU-T H.265, 7.3): headers that pictures refer to by
// number (parameter sets), and the slices of pictures.

using Bytes = std::vector<std::uint8_t>;
using ByteSpan = std::span<const std::uint8_t>;

// How units follow one another: each after its length in so many bytes, as in MP4 and Matroska; 0: each after a start
// code, as encoders give them.
[[nodiscard]] int nal_length_bytes(const AVCodecParameters& stream);

// The units of a packet, without lengths and start codes. Those of a damaged packet end where it is damaged.
[[nodiscard]] std::vector<ByteSpan> nal_units_of(ByteSpan packet, int length_bytes);

// Appends a unit to a packet.
void append_nal(Bytes& packet, ByteSpan unit, int length_bytes);

// Where decoding can begin, and what of the pictures around is lost there.
enum class KeyKind {
  none,        // no picture that decoding can begin with, or one that leaves earlier pictures in use (H.264's others)
  refresh,     // IDR, BLA: nothing before it is in use any more
  open_group,  // HEVC's CRA: pictures shown before it may refer to earlier ones
};
[[nodiscard]] KeyKind key_kind_of(ByteSpan packet, AVCodecID codec, int length_bytes);

// The numbers of the parameter sets in use.
struct ParameterSetIds {
  std::set<int> video;  // HEVC alone
  std::set<int> sequence;
  std::set<int> picture;
};

// The parameter sets in a stream's header (avcC, hvcC, or start codes).
[[nodiscard]] std::vector<ByteSpan> parameter_sets_in(const AVCodecParameters& stream);
[[nodiscard]] ParameterSetIds ids_of(const std::vector<ByteSpan>& parameter_sets, AVCodecID codec);

// The header with more parameter sets in it. Empty: it has no place for as many.
[[nodiscard]] Bytes with_parameter_sets(const AVCodecParameters& stream, const std::vector<Bytes>& more);

// Whether a unit says something about the stream without being needed to decode it (SEI), or marks where a picture
// begins or the stream ends.
[[nodiscard]] bool is_dispensable(ByteSpan unit, AVCodecID codec);
[[nodiscard]] bool is_parameter_set(ByteSpan unit, AVCodecID codec);

// Makes HEVC's CRA pictures of a packet BLA ones (H.265, 7.4.2.2), which the standard has for joints: the same picture,
// before which a decoder shows all that it still has. One byte of each slice changes.
void break_links(std::span<std::uint8_t> packet, int length_bytes);

// Renumbers the parameter sets of x265, which numbers all of them 0, and states the stream's level in them: x265
// refuses one beside a constant QP.
struct HevcNumbers {
  int video = 0;     // 0 to 15
  int sequence = 0;  // 0 to 15
  int picture = 15;  // 15 to 30: codes 8 bits longer than that of 0, so that slice data stays aligned to bytes
  int level = 0;     // general_level_idc, 30 times the level; stated where it is higher than x265's
};
[[nodiscard]] Bytes renumbered(ByteSpan unit, const HevcNumbers& numbers);

}  // namespace sigs::libav
