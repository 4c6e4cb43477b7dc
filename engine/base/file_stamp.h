// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>

namespace sigs {

// A file or folder as it lies on disk at one moment. What was made from it is out of date once its stamp is another
// one: a file's changes when it is written, a folder's when something in it appears or disappears.
struct FileStamp {
  std::filesystem::path path;  // "": none is named
  std::uintmax_t bytes = 0;    // 0 for a folder
  std::filesystem::file_time_type changed;
  bool exists = false;

  [[nodiscard]] bool operator==(const FileStamp&) const = default;
};

// The present stamp; exists is false where the path cannot be examined or is empty. Asks the file system.
[[nodiscard]] inline FileStamp stamp_of(const std::filesystem::path& path) {
  FileStamp stamp{.path = path};
  if (path.empty()) return stamp;
  std::error_code code;
  stamp.bytes = std::filesystem::file_size(path, code);
  if (code) stamp.bytes = 0;
  stamp.changed = std::filesystem::last_write_time(path, code);
  stamp.exists = !code;
  if (code) stamp.changed = {};
  return stamp;
}

}  // namespace sigs
