// SPDX-License-Identifier: MIT
#include "fuzz/fuzz_input.h"

#include <algorithm>
#include <fstream>

#include "base/ensure.h"

namespace sigs::fuzz {

namespace {

// 4800 bytes (base/result.h), each of which may have become the three of U+FFFD.
constexpr std::size_t kLongestMessage_bytes = 15'000;

void check_line(const std::string& text) {
  const bool is_one_line = std::none_of(text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; });
  ENSURE(is_one_line);
  ENSURE(text.size() <= kLongestMessage_bytes);
}

}  // namespace

std::filesystem::path FuzzInput::file(const std::string& name, std::string_view content) const {
  const std::filesystem::path path = folder / name;
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  ENSURE(out.good());
  return path;
}

void check_message(const Error& error) {
  ENSURE(!error.what.empty());
  check_line(error.text());
}

void check_messages(const std::vector<Warning>& warnings) {
  for (const Warning& warning : warnings) {
    ENSURE(!warning.what.empty());
    check_line(warning.text());
  }
}

}  // namespace sigs::fuzz
