// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "base/result.h"
#include "camera/lens.h"

namespace sigs {

// A lens and the image it throws. Pixels as in base/image.h.
struct Camera {
  Lens lens;
  cv::Size size_px;
  std::vector<Warning> warnings = {};  // what is doubtful about its calibration file (camera/calibration_warnings.h)
};

// Reads a calibration: OpenCV FileStorage XML or YAML, ROS camera_info YAML, plain YAML with nested lists, Gyroflow
// lens profile JSON. The flavour is seen from the content, not from the name. docs/calibration-files.md lists the keys.
//   footage_size_px  scales the calibration to the footage where both have the same shape; a different shape is an
//   error
//                    that names both sizes. A file that states no size is taken to be made for the footage. Without
//                    footage_size_px the file's own size is kept, and a file without one is an error.
//   model            the lens model that the numbers are of, whatever the file says; none: as the file says or, where
//                    it does not, as its numbers look
// Errors name file and field: {"gopro.xml: camera_matrix", "expected 9 numbers, found 8"}.
[[nodiscard]] Result<Camera> read_calibration(const std::filesystem::path& path,
                                              std::optional<cv::Size> footage_size_px = std::nullopt,
                                              std::optional<LensModel> model = std::nullopt);

}  // namespace sigs
