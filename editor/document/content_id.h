// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <compare>
#include <cstdint>
#include <filesystem>

#include "project/project.h"

namespace sigs::editor {

// A digest (FNV-1a, 128 bits, RFC 9923) of what images are made from. Equal digests mean equal content: two different
// contents of one session do not meet by chance. The default value belongs to nothing.
struct ContentId {
  std::uint64_t high = 0;
  std::uint64_t low = 0;

  [[nodiscard]] auto operator<=>(const ContentId&) const = default;
};

// Digest of the settings that the images and the truth of a project depend on, with its paths resolved to absolute
// ones. Left out are the project's own name and place, how its own body is looked for, its export settings, and keys
// that this program does not know. Reads nothing from disk.
[[nodiscard]] ContentId content_id_of(const Project& project);

// Digest of the stamps of all files that a project names (footage, calibration, mask, attitude, flight log, models):
// another one as soon as one of them appears, disappears or is written. Asks the file system.
[[nodiscard]] ContentId input_files_id_of(const Project& project);

// Digest of both: images with equal ids are the same.
[[nodiscard]] ContentId combined_id(const ContentId& content, const ContentId& input_files);

// A file as it lies on disk at one moment. What was made from a file is out of date once its stamp is another one.
struct FileStamp {
  std::filesystem::path path;  // "": none is named
  std::uintmax_t bytes = 0;
  std::filesystem::file_time_type changed;
  bool exists = false;

  [[nodiscard]] bool operator==(const FileStamp&) const = default;
};

// How often files are looked at for changes from outside.
inline constexpr std::chrono::milliseconds kFileCheckInterval(1000);

// Stamp of a file; exists is false where it cannot be read or the path is empty. Asks the file system.
[[nodiscard]] FileStamp stamp_of(const std::filesystem::path& path);

// Digest of one stamp.
[[nodiscard]] ContentId id_of(const FileStamp& stamp);

// Stamp of the project's video, under its absolute path.
[[nodiscard]] FileStamp footage_stamp_of(const Project& project);

}  // namespace sigs::editor
