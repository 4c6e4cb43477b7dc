// SPDX-License-Identifier: MIT
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <opencv2/core.hpp>
#include <vector>

#include "appearance/sun.h"
#include "camera/camera.h"

namespace sigs {

// The long dark patches on the ground ahead of the camera, laid flat; see Sun.
//   luma               CV_8UC1, of the camera's size
//   world_from_camera  attitude against the level
//   own_body           CV_8UC1 of the same size, above 127 where hidden; may be empty
[[nodiscard]] std::vector<Sun::Patch> shadow_patches(const cv::Mat& luma, const Camera& camera,
                                                     const glm::dquat& world_from_camera, const cv::Mat& own_body);

}  // namespace sigs
