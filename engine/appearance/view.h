// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <opencv2/core.hpp>
#include <optional>

#include "camera/camera.h"

namespace sigs {

// What is known of the camera at one frame, besides its image. Everything may be missing; what an estimate needs of it
// stands in the header of that estimate.
struct View {
  const Camera* camera = nullptr;               // of the frame's size; null: not known
  std::optional<glm::dquat> world_from_camera;  // attitude against the level (Pose in base/pose.h)
  std::optional<double> height_m;               // of the camera above the ground, which is taken as flat
  cv::Mat own_body;                             // CV_8UC1 of the frame's size, above 127: hidden; empty: nothing is
};

}  // namespace sigs
