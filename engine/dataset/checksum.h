// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "base/result.h"

namespace sigs {

// SHA-256 (FIPS 180-4) of what is added, in lower-case hexadecimal.
class Checksum {
 public:
  Checksum();
  Checksum(Checksum&&) noexcept;
  Checksum& operator=(Checksum&&) noexcept;
  ~Checksum();

  void add(std::string_view bytes);

  // Call it once; nothing is added after it.
  [[nodiscard]] std::string text();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

[[nodiscard]] std::string checksum_of_text(std::string_view text);

// Of a file's content, however large. Errors: cannot_read; interrupted, where cancel is set meanwhile.
[[nodiscard]] Result<std::string> checksum_of_file(const std::filesystem::path& file,
                                                   const std::atomic<bool>* cancel = nullptr);

// One line of a list that `sha256sum --check` reads: checksum, two spaces, path, newline. Odd names are escaped as it
// escapes them.
[[nodiscard]] std::string checksum_line(const std::string& checksum, const std::string& path);

}  // namespace sigs
