// SPDX-License-Identifier: MIT
#include "video/libav/ffv1_check.h"

extern "C" {
#include <libavutil/crc.h>
}

namespace sigs::libav {
namespace {

// slice_size (3 bytes, big endian, of what lies before the footer), error_status (1), slice_crc_parity (4).
constexpr size_t kFooterBytes = 8;

}  // namespace

bool ffv1_checksums_match(std::span<const uint8_t> packet) {
  if (packet.empty()) return false;
  const AVCRC* table = av_crc_get_table(AV_CRC_32_IEEE);
  while (!packet.empty()) {
    if (packet.size() < kFooterBytes) return false;
    const auto footer = packet.last(kFooterBytes);
    const size_t slice_bytes = (size_t{footer[0]} << 16 | size_t{footer[1]} << 8 | footer[2]) + kFooterBytes;
    if (slice_bytes > packet.size()) return false;
    // The checksum is chosen so that the whole slice with it has the remainder 0.
    if (av_crc(table, 0, packet.last(slice_bytes).data(), slice_bytes) != 0) return false;
    packet = packet.first(packet.size() - slice_bytes);
  }
  return true;
}

}  // namespace sigs::libav
