// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.h"
#include "base/staged_outputs.h"

namespace sigs::cli {

// An output that an option asks for.
struct CommandOutput {
  const char* option;          // "--plot"
  std::filesystem::path path;  // empty: not asked for
};

// The bytes of an output, made only where it is asked for.
struct OutputBytes {
  std::filesystem::path path;  // empty: not asked for
  std::function<Result<std::string>()> bytes;
};

// The names of a command's outputs, before anything is read: that of --plot ends in .png, no two outputs go to the same
// file, and none replaces an input. Errors usage, cannot_create.
[[nodiscard]] Result<void> check_outputs(const std::vector<CommandOutput>& outputs,
                                         const std::vector<std::filesystem::path>& inputs);

// An output of images by the same rules. `option` is named in the errors.
[[nodiscard]] Result<void> check_png_output(const std::string& option, const std::filesystem::path& path,
                                            const std::vector<std::filesystem::path>& inputs);

// An image as PNG, encoded in memory: OpenCV's own writing of files prints lines on stderr, and does not notice where
// the last bytes find no room.
[[nodiscard]] std::string png_bytes(const cv::Mat& image);

// Files that get their final names together, once all of them are written. Without commit() none is left.
class OutputFiles {
 public:
  explicit OutputFiles(bool overwrite)
      : outputs_(overwrite ? StagedOutputs::Existing::replace : StagedOutputs::Existing::refuse) {}

  // Takes the name, so that what stands in the way shows before the work begins. Errors as StagedOutputs::add_file.
  [[nodiscard]] Result<void> reserve(const std::filesystem::path& path);

  // The names of all outputs that are asked for.
  [[nodiscard]] Result<void> reserve(const std::vector<CommandOutput>& outputs);

  // Write under a name taken before, or take it; an image as PNG. Error write_failed.
  [[nodiscard]] Result<void> write(const std::filesystem::path& path, std::string_view bytes);
  [[nodiscard]] Result<void> write(const std::filesystem::path& path, const cv::Mat& image);

  // The temporary file of a name that was taken, to be written piece by piece; errors of that with the final name.
  [[nodiscard]] std::filesystem::path staged(const std::filesystem::path& path) const { return staged_.at(path); }
  [[nodiscard]] Error with_final_names(Error error) const { return outputs_.with_final_names(std::move(error)); }

  // Final names for all.
  [[nodiscard]] Result<void> commit() { return outputs_.commit(); }
  [[nodiscard]] Result<void> write_and_commit(const std::vector<OutputBytes>& outputs);

  // In the order in which they were taken.
  [[nodiscard]] std::vector<std::filesystem::path> final_paths() const { return outputs_.final_paths(); }

 private:
  StagedOutputs outputs_;
  std::map<std::filesystem::path, std::filesystem::path> staged_;  // temporary files by their final names
};

// Prints the names of files that were written, a line each.
void print_written(const std::vector<std::filesystem::path>& paths);

}  // namespace sigs::cli
