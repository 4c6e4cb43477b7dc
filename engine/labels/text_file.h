// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>

#include "base/result.h"

namespace sigs {

// A text that is written piece by piece, so that memory does not grow with the video. Errors name the file.
class TextFile {
 public:
  // Error cannot_create. What is there is emptied.
  [[nodiscard]] static Result<TextFile> create(std::filesystem::path path);

  // Errors write_failed.
  [[nodiscard]] Result<void> put(std::string_view text);
  [[nodiscard]] Result<void> close();

 private:
  TextFile(std::filesystem::path path, std::ofstream out);

  std::filesystem::path path_;
  std::ofstream out_;
};

// A small one, whole. Errors of both.
[[nodiscard]] Result<void> write_text_file(const std::filesystem::path& path, std::string_view text);

// Makes a folder within one that is there. Error cannot_create.
[[nodiscard]] Result<void> make_inner_folder(const std::filesystem::path& folder);

}  // namespace sigs
