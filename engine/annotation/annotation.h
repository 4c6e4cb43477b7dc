// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/pose.h"

namespace sigs {

// The truth of one intruder in one frame. docs/annotation-format.md has the formula of each.
struct IntruderTruth {
  int id = 0;
  std::string name;
  glm::dvec3 position_m{0, 0, 0};  // of the reference point, in the camera frame
  Attitude attitude;               // in the world
  bool in_picture = false;         // some of it lies within the picture and in front of the lens, hidden or not
  double visible_fraction = 0;     // of the whole silhouette's area: what lies in the picture and is not hidden
  std::optional<cv::Rect> box;     // visible pixels; none where nothing is visible
  std::optional<Box> silhouette;   // the whole of it through the lens; none where no part of it has an image
};

struct FrameTruth {
  int index = 0;  // counts the footage's frames from 0
  double time_s = 0;
  glm::dvec3 camera_position_m{0, 0, 0};  // in the world
  Attitude camera_attitude;
  std::vector<IntruderTruth> intruders;  // by id
};

}  // namespace sigs
