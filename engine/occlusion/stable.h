// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <opencv2/core.hpp>

#include "occlusion/method.h"

namespace sigs {

[[nodiscard]] std::unique_ptr<DetectionMethod> stable_method(const StableOwnBodySettings& settings, cv::Size size_px);

}  // namespace sigs
