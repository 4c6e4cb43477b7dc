// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/staged_outputs.h"

namespace sigs::cli {

// Writes a file under its temporary name (StagedOutputs). Error write_failed.
[[nodiscard]] Result<void> write_bytes(const std::filesystem::path& staged, std::string_view bytes);

// The same of an image, as PNG, encoded in memory: OpenCV's own writing of files prints lines on stderr, and does not
// notice where the last bytes find no room.
[[nodiscard]] Result<void> write_png(const std::filesystem::path& staged, const cv::Mat& image);

// PNG files that get their final names together, once all of them are written. Without commit() none is left.
class ImageFiles {
 public:
  explicit ImageFiles(bool overwrite)
      : outputs_(overwrite ? StagedOutputs::Existing::replace : StagedOutputs::Existing::refuse) {}

  // Takes the name, so that what stands in the way shows before the images are made. Errors as
  // StagedOutputs::add_file.
  [[nodiscard]] Result<void> reserve(const std::filesystem::path& path);

  // Writes under a name taken before, or takes it. Error write_failed.
  [[nodiscard]] Result<void> write(const std::filesystem::path& path, const cv::Mat& image);

  // Final names for all, in the order in which they were taken; what they are.
  [[nodiscard]] Result<std::vector<std::filesystem::path>> commit();

 private:
  StagedOutputs outputs_;
  // Temporary files by their final names.
  std::map<std::filesystem::path, std::filesystem::path> staged_;
};

// Folders made for what is to be written. Those that are empty at the end go again: a run that fails or is interrupted
// leaves nothing behind. A folder that was there before stays.
class CreatedFolders {
 public:
  CreatedFolders() = default;
  CreatedFolders(CreatedFolders&&) = default;
  CreatedFolders& operator=(CreatedFolders&&) = delete;
  ~CreatedFolders();

  // The folder and those above it, where they are not there. Error cannot_create.
  [[nodiscard]] Result<void> make(const std::filesystem::path& folder);

 private:
  std::vector<std::filesystem::path> created_;  // the outer before the inner
};

}  // namespace sigs::cli
