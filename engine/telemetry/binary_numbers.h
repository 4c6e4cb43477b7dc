// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

#include "base/ensure.h"

namespace sigs {

// Numbers in binary logs.

enum class NumberType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

// Bytes that a number takes.
[[nodiscard]] inline std::size_t size_of(NumberType type) {
  switch (type) {
    case NumberType::int8:
    case NumberType::uint8:
      return 1;
    case NumberType::int16:
    case NumberType::uint16:
      return 2;
    case NumberType::int32:
    case NumberType::uint32:
    case NumberType::float32:
      return 4;
    case NumberType::int64:
    case NumberType::uint64:
    case NumberType::float64:
      return 8;
  }
  return 8;
}

// The unsigned integer of 1 to 8 bytes, least or most significant byte first. The caller has checked that the bytes are
// no more than 8.
[[nodiscard]] inline std::uint64_t little_endian(std::string_view bytes) {
  ENSURE(bytes.size() <= 8);
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}
[[nodiscard]] inline std::uint64_t big_endian(std::string_view bytes) {
  ENSURE(bytes.size() <= 8);
  std::uint64_t value = 0;
  for (const char byte : bytes) value = value << 8 | static_cast<unsigned char>(byte);
  return value;
}

// The number at a place, least significant byte first. NaN where it does not lie within the bytes. Integers beyond 2^53
// are rounded to the nearest double.
[[nodiscard]] inline double number_at(std::string_view bytes, std::size_t offset, NumberType type) {
  const std::size_t size = size_of(type);
  if (offset > bytes.size() || bytes.size() - offset < size) return std::numeric_limits<double>::quiet_NaN();
  const std::uint64_t bits = little_endian(bytes.substr(offset, size));
  switch (type) {
    case NumberType::int8:
      return static_cast<std::int8_t>(bits);
    case NumberType::int16:
      return static_cast<std::int16_t>(bits);
    case NumberType::int32:
      return static_cast<std::int32_t>(bits);
    case NumberType::int64:
      return static_cast<double>(static_cast<std::int64_t>(bits));
    case NumberType::float32:
      return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    case NumberType::float64:
      return std::bit_cast<double>(bits);
    default:
      return static_cast<double>(bits);
  }
}

}  // namespace sigs
