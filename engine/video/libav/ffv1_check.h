// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

namespace sigs::libav {

// Whether every slice of an FFV1 version 3 packet carries a matching checksum (RFC 9043, section 4.9, slice footer). A
// stream written without checksums never matches. FFmpeg's decoder hides a damaged slice without a word.
[[nodiscard]] bool ffv1_checksums_match(std::span<const uint8_t> packet);

}  // namespace sigs::libav
