// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "base/result.h"
#include "camera/camera.h"

namespace sigs {

// A camera as its calibration file has it, and what is doubtful about it: another shape than the footage's, settings of
// a profile of which nobody can tell whether they were on.
struct CalibrationFile {
  Camera camera;
  std::vector<Warning> warnings;
};

// As read_calibration() (camera.h), with the warnings.
[[nodiscard]] Result<CalibrationFile> read_calibration_file(const std::filesystem::path& path,
                                                            std::optional<cv::Size> footage_size_px = std::nullopt);

}  // namespace sigs
