// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <opencv2/core.hpp>

#include "occlusion/method.h"

namespace sigs {

// Section 4 of the paper as published; its steps are in paper_steps.h, where it works and where not in README.md. The
// confidence says how far a pixel is from the mask's border, measured by how far the steps move that border; of the
// method's being right on this footage it says nothing. Undecided where no frame differs from the one before.
[[nodiscard]] std::unique_ptr<DetectionMethod> paper_method(const PaperOwnBodySettings& settings, cv::Size size_px);

}  // namespace sigs
