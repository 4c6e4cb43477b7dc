// SPDX-License-Identifier: MIT
#include "occlusion/method.h"

#include "occlusion/paper.h"
#include "occlusion/stable.h"

namespace sigs {

std::unique_ptr<DetectionMethod> detection_method(const OwnBodySettings& settings, cv::Size size_px) {
  if (settings.method == OwnBodyMethod::paper) return paper_method(settings.paper, size_px);
  return stable_method(settings.stable, size_px);
}

}  // namespace sigs
