// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <type_traits>

#include "base/ensure.h"

namespace sigs {

// Numbers in binary logs.

// The number that the bits of one are, least significant first. Integers beyond 2^53 are rounded to the nearest double.
template <class Number>
[[nodiscard]] double number_of_bits(std::uint64_t bits) {
  if constexpr (std::is_same_v<Number, float>)
    return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
  else if constexpr (std::is_same_v<Number, double>)
    return std::bit_cast<double>(bits);
  else
    return static_cast<double>(static_cast<Number>(bits));
}

struct NumberType {
  std::size_t bytes = 0;
  double (*number_of)(std::uint64_t bits) = nullptr;  // nullptr: what is stored is no number

  [[nodiscard]] bool operator==(const NumberType&) const = default;
};
template <class Number>
inline constexpr NumberType kNumberType{sizeof(Number), number_of_bits<Number>};

// A type that a format has a letter for. What is meant is the number that is stored times `scale`.
struct LetterType {
  char letter = '\0';
  NumberType type;
  double scale = 1;
};

// The letter's line of a table; a type of 0 bytes where the table lacks it.
[[nodiscard]] inline LetterType type_of_letter(std::span<const LetterType> table, char letter) {
  const auto found = std::ranges::find(table, letter, &LetterType::letter);
  return found != table.end() ? *found : LetterType{};
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

// The number at a place, least significant byte first. NaN where it does not lie within the bytes.
[[nodiscard]] inline double number_at(std::string_view bytes, std::size_t offset, NumberType type) {
  if (offset > bytes.size() || bytes.size() - offset < type.bytes) return std::numeric_limits<double>::quiet_NaN();
  return type.number_of(little_endian(bytes.substr(offset, type.bytes)));
}

}  // namespace sigs
