// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "camera/camera.h"

namespace sigs::footage {

// The part of the aircraft in view of the camera on its back: the nose with its pitot boom. It is fixed in the
// image.
struct OwnBody {
  cv::Mat_<cv::Vec3f> color;  // linear light, premultiplied
  cv::Mat_<float> cover;      // 0..1; the lens is focused far away, so the edges are soft
};

[[nodiscard]] OwnBody own_body(const Camera& camera);

}  // namespace sigs::footage
