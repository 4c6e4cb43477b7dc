// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/result.h"
#include "camera/camera.h"
#include "dataset/recipe.h"
#include "project/project.h"
#include "scene/scene.h"

namespace sigs {

// What a plan has to know of a background: its footage's shape, its lens, the frames that may be used.
struct OpenedBackground {
  FootageShape footage;
  Camera lens;
  FrameRange frames;
};

// Opens what each background names, each clip once. Errors name recipe and key; a clip that cannot be opened is the
// error of its background alone, as long as there is another one.
[[nodiscard]] Result<std::vector<Result<OpenedBackground>>> opened_backgrounds(const Recipe& recipe);

}  // namespace sigs
