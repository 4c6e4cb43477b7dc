// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string_view>

#include "calibration/rough_fit.h"

namespace sigs {

// The field of view that a camera has written into its file: not measured, and of a mode that the footage may have been
// cropped from since.
//   GoPro GPMF ZFOV  diagonal field of view in degrees
//   DJI subtitles    focal_len, in millimetres for an image 36 mm wide, some in tenths: "24.00", "240"
// The distortion is the prior's.
//   file  the video, or a file of subtitles
// Refused where it states neither. Never an error: a file that cannot be read states nothing.
[[nodiscard]] RoughAnswer stated_lens(const std::filesystem::path& file, cv::Size size_px,
                                      const DistortionPrior& prior);

// The focal length for an image 36 mm wide that DJI's subtitles state first, mm; between 10 and 300.
[[nodiscard]] std::optional<double> dji_focal_mm(std::string_view subtitles);

// The first diagonal field of view in a payload of GPMF, radians; between 5 and 180 degrees.
[[nodiscard]] std::optional<double> gopro_diagonal_field_rad(std::string_view payload);

}  // namespace sigs
