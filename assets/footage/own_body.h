// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "camera/camera.h"

namespace sigs::footage {

// What of the aircraft itself the camera on its back sees: the nose with its pitot boom. It stands still in the
// image.
struct OwnBody {
  cv::Mat_<cv::Vec3f> color;  // linear light, premultiplied
  cv::Mat_<float> cover;      // 0..1; the lens is focused far away, so the edges are soft
};

[[nodiscard]] OwnBody own_body(const Camera& camera);

}  // namespace sigs::footage
