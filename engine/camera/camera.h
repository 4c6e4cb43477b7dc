// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "camera/lens.h"

namespace sigs {

// A lens and the size of its images. Pixels as in base/image.h.
struct Camera {
  Lens lens;
  cv::Size size_px;
  std::vector<Warning> warnings = {};  // implausible values of its calibration file (camera/calibration_formats.h)
};

// A calibration as settings and options name it: a file, or one camera of a file that describes several, by the name
// that it has there: rig.yaml#cam1.
struct CalibrationName {
  std::filesystem::path file;
  std::string camera;  // empty: not named
};

// A file whose own name has the # goes before. Looks at the file system for that alone.
[[nodiscard]] CalibrationName calibration_name(const std::filesystem::path& name);

// The camera of 360 degree footage: an equirectangular image that covers 360 by 180 degrees, azimuth 0 in its middle.
// The size alone determines it:
//   azimuth = (u + 0.5) / width * 2 pi - pi, to the right;  elevation = pi / 2 - (v + 0.5) / height * pi
// Warned of where the width is not twice the height.
[[nodiscard]] Camera equirectangular_camera(cv::Size size_px);

// Reads a calibration: OpenCV FileStorage XML or YAML, ROS camera_info YAML, plain YAML with nested lists, Gyroflow
// lens profile JSON, one camera of a rig (rig_calibration.h). The format is recognised by the content, not by the name.
// docs/calibration-files.md lists the keys.
//   path             a file, or FILE#CAMERA (CalibrationName). Without a camera's name the first of several is read,
//                    with a warning but for the left one of a pair. Empty: of a model that the footage's size alone
//                    determines (needs_calibration()), else an error
//   footage_size_px  size of the images that the camera is wanted for. The calibration is scaled to it where both have
//                    the same shape; a different shape is an error that names both sizes. A file without a size is
//                    taken to be made for the footage. If omitted, the file's own size is kept, and a file without one
//                    is an error
//   part             of larger images, which the images are: footage.crop. A calibration that states the larger one's
//                    size, or has its shape and not the part's, has its principal point moved by the corner, with a
//                    warning; one that states neither's size and has the shape of both is an error
//   model            the lens model of the coefficients, whatever the file says. If omitted, the model that the file
//                    states or, where it states none, the one that its coefficients suggest
// Errors name file and field: {"gopro.xml: camera_matrix", "expected 9 numbers, found 8"}. The kind is cannot_read
// where the file cannot be opened, else bad_data.
[[nodiscard]] Result<Camera> read_calibration(const std::filesystem::path& path,
                                              std::optional<cv::Size> footage_size_px = std::nullopt,
                                              std::optional<LensModel> model = std::nullopt,
                                              const std::optional<ImagePart>& part = std::nullopt);

}  // namespace sigs
