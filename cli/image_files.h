// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <vector>

#include "base/result.h"
#include "base/staged_outputs.h"

namespace sigs::cli {

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
  std::map<std::filesystem::path, std::filesystem::path> staged_;  // by final name
};

}  // namespace sigs::cli
