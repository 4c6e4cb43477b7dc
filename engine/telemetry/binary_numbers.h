// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace sigs {

// Numbers in binary logs.

enum class NumberType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

// Bytes that a number takes.
[[nodiscard]] std::size_t size_of(NumberType type);

// The number at a place, least significant byte first. NaN where it does not lie within the bytes. Integers beyond 2^53
// are rounded to the nearest double.
[[nodiscard]] double number_at(std::string_view bytes, std::size_t offset, NumberType type);

// The unsigned integer of 1 to 8 bytes, least or most significant byte first. The caller has checked that the bytes are
// no more than 8.
[[nodiscard]] std::uint64_t little_endian(std::string_view bytes);
[[nodiscard]] std::uint64_t big_endian(std::string_view bytes);

}  // namespace sigs
