// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "base/result.h"
#include "project/project.h"

namespace sigs {

// SHA-256 (FIPS 180-4) of all bytes that were added.
class Checksum {
 public:
  Checksum();
  Checksum(Checksum&&) noexcept;
  Checksum& operator=(Checksum&&) noexcept;
  ~Checksum();

  void add(std::string_view bytes);

  // 64 digits, hexadecimal, lower case. To be called once; nothing may be added after it.
  [[nodiscard]] std::string text();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

[[nodiscard]] std::string checksum_of_text(std::string_view text);

// Checksum of a file's content, read piece by piece. Errors: cannot_read; interrupted, where cancel was set meanwhile.
[[nodiscard]] Result<std::string> checksum_of_file(const std::filesystem::path& file,
                                                   const std::atomic<bool>* cancel = nullptr);

// One line of a list that `sha256sum --check` reads: checksum, two blanks, path, newline. Backslashes and ends of lines
// in the path are escaped as sha256sum (GNU coreutils) escapes them.
[[nodiscard]] std::string checksum_line(const std::string& checksum, const std::string& path);

// Checksums of the files that projects read; each file is read once. May be called from any thread.
class InputChecksums {
 public:
  explicit InputChecksums(const std::atomic<bool>* cancel = nullptr) : cancel_(cancel) {}

  // Errors cannot_read, interrupted.
  [[nodiscard]] Result<std::string> of(const std::filesystem::path& file);

  // One checksum of an OBJ model, its material libraries and the images that those name.
  [[nodiscard]] Result<std::string> of_model(const std::filesystem::path& file);

  // One checksum of all images of a sequence (video/image_sequence.h).
  [[nodiscard]] Result<std::string> of_images(const std::filesystem::path& sequence);

 private:
  std::mutex mutex_;
  std::map<std::filesystem::path, Result<std::string>> files_;
  std::map<std::filesystem::path, Result<std::string>> models_;
  const std::atomic<bool>* cancel_;
};

// The fingerprint of a video: one checksum of all that its export depends on, which is the program's name and version,
// the project, and the content of the files that the project names. Of a path only the file's name counts, since labels
// contain it.
[[nodiscard]] Result<std::string> fingerprint_of(const Project& project, const std::string& program,
                                                 InputChecksums& inputs);

}  // namespace sigs
