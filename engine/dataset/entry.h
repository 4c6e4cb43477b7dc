// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/json.h"
#include "base/result.h"
#include "dataset/plan.h"
#include "project/project.h"

namespace sigs {

// SHA-256 (FIPS 180-4): 64 digits, hexadecimal, lower case.
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
  [[nodiscard]] Result<std::string> of_all(const Result<std::vector<std::filesystem::path>>& files);

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

// A file of a dataset with its size and checksum.
struct DatasetFile {
  std::string path;  // from the folder it is listed for; / between folders
  std::uintmax_t bytes = 0;
  std::string sha256;  // hexadecimal, lower case

  [[nodiscard]] bool operator==(const DatasetFile&) const = default;
};

// What FOLDER/NAME/entry.json says of one finished video. It is written last, so a folder that has it is whole.
struct VideoEntry {
  std::string planned;                    // fingerprint_of() the planned project
  int frames = 0;                         // number of frames exported
  std::vector<DatasetFile> files;         // of the video's folder, by path, without the project and the entry itself
  std::optional<MeasuredLook> look = {};  // of a matched background
};

inline constexpr const char* kEntryName = "entry.json";

// The text of entry.json, which describes the planned video too, and has its look.
[[nodiscard]] std::string entry_text(const PlannedVideo& video, const VideoEntry& entry);

// Errors cannot_read, bad_data.
[[nodiscard]] Result<VideoEntry> read_entry(const std::filesystem::path& file);

// Parts of entry.json and index.json: a video with name, split, tags and sampled quantities; a list of files, with
// `before` in front of each path.
[[nodiscard]] Json described(const PlannedVideo& video);
[[nodiscard]] Json described(const std::vector<DatasetFile>& files, const std::string& before);

// Checksums of files by device and inode, so that a file with several names is read once.
class ChecksumCache {
 public:
  // Takes the checksums of an entry without reading the files.
  void remember(const std::filesystem::path& folder, const VideoEntry& entry);

  // Error cannot_read, interrupted.
  [[nodiscard]] Result<std::string> checksum_of(const std::filesystem::path& file, const std::atomic<bool>* cancel);

 private:
  using Identity = std::pair<std::uintmax_t, std::uintmax_t>;  // device and inode
  [[nodiscard]] static std::optional<Identity> identity_of(const std::filesystem::path& file);
  std::map<Identity, std::string> checksums_;
};

// All files under a folder, sorted by the bytes of their paths, without the paths of `left_out`. Errors cannot_read,
// interrupted.
[[nodiscard]] Result<std::vector<DatasetFile>> files_in(const std::filesystem::path& folder,
                                                        const std::vector<std::string>& left_out, ChecksumCache& known,
                                                        const std::atomic<bool>* cancel);

// What is wrong with the files of an entry: one is missing, or has another size or checksum. Empty: nothing.
// Error interrupted.
[[nodiscard]] Result<std::string> damage_of(const std::filesystem::path& folder, const VideoEntry& entry,
                                            const std::atomic<bool>* cancel);

// The first file under the folder that is neither in the entry nor in `left_out`; none: there is no other file.
[[nodiscard]] std::optional<std::string> unlisted_file_in(const std::filesystem::path& folder, const VideoEntry& entry,
                                                          const std::vector<std::string>& left_out);

}  // namespace sigs
