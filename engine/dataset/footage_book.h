// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/frame_range.h"
#include "base/result.h"
#include "camera/camera.h"
#include "dataset/recipe.h"
#include "scene/scene.h"

namespace sigs {

// What a plan has to know of a background: its footage's shape, its lens, the frames that may be used.
struct OpenedBackground {
  FootageShape footage;
  Camera lens;
  FrameRange frames;
};

// Opens the footage and calibration of each background, each file once. Errors name recipe and key.
[[nodiscard]] Result<std::vector<OpenedBackground>> opened_backgrounds(const Recipe& recipe);

}  // namespace sigs
