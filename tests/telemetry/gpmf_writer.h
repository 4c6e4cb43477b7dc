// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace sigs::test {

// GPMF payloads for tests, written from the format's description.

inline std::string big_endian_bytes(std::uint64_t number, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(number >> (8 * i) & 0xff);
  return text;
}

inline std::string gpmf(std::string_view key, char type, int size, int repeat, std::string value) {
  std::string text(key);
  text += type;
  text += static_cast<char>(size);
  text += big_endian_bytes(static_cast<std::uint64_t>(repeat), 2) + value;
  text.resize((text.size() + 3) / 4 * 4, '\0');
  return text;
}

inline std::string gpmf_nest(std::string_view key, const std::string& inside) {
  return gpmf(key, '\0', 4, static_cast<int>(inside.size() / 4), inside);
}

inline std::string gpmf_string(std::string_view key, const std::string& text) {
  return gpmf(key, 'c', 1, static_cast<int>(text.size()), text);
}

inline std::string gpmf_u32(std::string_view key, std::uint32_t number) {
  return gpmf(key, 'L', 4, 1, big_endian_bytes(number, 4));
}

inline std::string gpmf_shorts(std::string_view key, int columns, const std::vector<int>& numbers) {
  std::string value;
  for (const int number : numbers) value += big_endian_bytes(static_cast<std::uint64_t>(number), 2);
  return gpmf(key, 's', 2 * columns, static_cast<int>(numbers.size()) / columns, value);
}

inline std::string gpmf_ints(std::string_view key, int columns, const std::vector<int>& numbers) {
  std::string value;
  for (const int number : numbers) value += big_endian_bytes(static_cast<std::uint64_t>(number), 4);
  return gpmf(key, 'l', 4 * columns, static_cast<int>(numbers.size()) / columns, value);
}

inline std::string gpmf_floats(std::string_view key, int columns, const std::vector<float>& numbers) {
  std::string value;
  for (const float number : numbers) value += big_endian_bytes(std::bit_cast<std::uint32_t>(number), 4);
  return gpmf(key, 'f', 4 * columns, static_cast<int>(numbers.size()) / columns, value);
}

}  // namespace sigs::test
