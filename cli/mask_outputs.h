// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "cli/output_files.h"
#include "occlusion/detect.h"

namespace sigs::cli {

// Where `sigs mask` writes.
struct MaskPaths {
  // PNG files, and a folder for images of the steps. Confidence and stages may be empty: not asked for.
  std::filesystem::path mask;
  std::filesystem::path confidence;
  std::filesystem::path stages;
};

// The images of one run. They get their names together, or none of them and no folder is left.
class MaskOutputs {
 public:
  // Before the work begins: finding that a file stands in the way after minutes would be late. inputs: what the command
  // reads; may be empty paths. Errors: usage (not a PNG, one output where another goes), cannot_create.
  [[nodiscard]] static Result<MaskOutputs> reserved(MaskPaths paths, const std::vector<std::filesystem::path>& inputs,
                                                    bool overwrite);

  [[nodiscard]] bool has_stages() const { return !paths_.stages.empty(); }

  // Writes all; what the files are called. bgr: a frame of the footage, for the stages; empty where there are none.
  // Images of stages that another run has left in the folder go: they would look like steps of this one.
  [[nodiscard]] Result<std::vector<std::filesystem::path>> write(const OwnBody& found, const cv::Mat& bgr);

 private:
  MaskOutputs(MaskPaths paths, bool overwrite) : paths_(std::move(paths)), overwrite_(overwrite), files_(overwrite) {}
  // Checks a name against the inputs, makes the folder that it lies in and takes it. option: named in the error.
  [[nodiscard]] Result<void> reserve(const char* option, const std::filesystem::path& path,
                                     const std::vector<std::filesystem::path>& inputs);
  [[nodiscard]] Result<void> reserve_stages(const std::vector<std::filesystem::path>& inputs);
  [[nodiscard]] Result<void> write_stages(const OwnBody& found, const cv::Mat& bgr);
  // File of a step in the folder, by its number and name.
  [[nodiscard]] std::filesystem::path stage(std::size_t number, std::string_view name) const;

  MaskPaths paths_;
  bool overwrite_ = false;
  CreatedFolders folders_;  // outlives the files: a folder can go only once it is empty
  OutputFiles files_;
};

// Whether an image of a step, of any method, may have this name: "03_canny.png".
[[nodiscard]] bool is_stage_name(std::string_view file_name);

}  // namespace sigs::cli
