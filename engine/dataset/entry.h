// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "dataset/plan.h"

namespace sigs {

// A file of a dataset and what it holds.
struct DatasetFile {
  std::string path;  // from the folder it is listed for; / between folders
  std::uintmax_t bytes = 0;
  std::string sha256;

  [[nodiscard]] bool operator==(const DatasetFile&) const = default;
};

// What is known of one finished video: FOLDER/NAME/entry.json.
struct VideoEntry {
  std::string planned;  // fingerprint_of() what was planned
  int frames = 0;       // exported
  std::vector<DatasetFile>
      files;  // of the video's folder, by path; the project and the entry itself are not among them
};

inline constexpr const char* kEntryName = "entry.json";

// The file's text. What the video is stands in it as the plan has it.
[[nodiscard]] std::string entry_text(const PlannedVideo& video, const VideoEntry& entry);

// Errors cannot_read, bad_data.
[[nodiscard]] Result<VideoEntry> read_entry(const std::filesystem::path& file);

// Checksums of files by what they are on the disk: one with several names is read once.
class ChecksumCache {
 public:
  // Takes an entry's word for its files.
  void remember(const std::filesystem::path& folder, const VideoEntry& entry);

  // Error cannot_read, interrupted.
  [[nodiscard]] Result<std::string> checksum_of(const std::filesystem::path& file, const std::atomic<bool>* cancel);

 private:
  using Identity = std::pair<std::uintmax_t, std::uintmax_t>;  // device and inode
  [[nodiscard]] static std::optional<Identity> identity_of(const std::filesystem::path& file);
  std::map<Identity, std::string> checksums_;
};

// All files under a folder, by path (bytes compared), but for those left out.
[[nodiscard]] Result<std::vector<DatasetFile>> files_in(const std::filesystem::path& folder,
                                                        const std::vector<std::string>& left_out, ChecksumCache& known,
                                                        const std::atomic<bool>* cancel);

// Whether the files of an entry are all there and hold what they should. What is wrong; empty: nothing.
// Error interrupted.
[[nodiscard]] Result<std::string> damage_of(const std::filesystem::path& folder, const VideoEntry& entry,
                                            const std::atomic<bool>* cancel);

// A file under the folder that is none of the entry's, nor left out; none: there is nothing else.
[[nodiscard]] std::optional<std::string> unlisted_file_in(const std::filesystem::path& folder, const VideoEntry& entry,
                                                          const std::vector<std::string>& left_out);

}  // namespace sigs
