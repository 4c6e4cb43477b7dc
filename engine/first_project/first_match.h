// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "base/result.h"
#include "first_project/first_project.h"
#include "scene/scene.h"
#include "video/frame_source.h"

namespace sigs {

// How a long step goes on: its share that is done, 0 to 1, and whether it is to end.
struct MatchControl {
  std::function<void(double share)> progress;  // called on the calling thread; may be empty
  const std::atomic<bool>* cancel = nullptr;   // set to true: ends soon with the error `interrupted`; may be null
};

// Makes the project's intruders look as if the footage's camera had filmed them: what `sigs appearance --into` writes,
// of the scene's range. What the footage does not tell gets the estimate's default. One note for each group of settings
// that belong together, with what was found, or why it is not known. Not known is here what needs the camera's height
// above the ground, which no footage states: the visibility.
//   footage  opened with Quantisers::read
// Errors: those of FrameSource::read(), interrupted.
[[nodiscard]] Result<std::vector<FirstProjectNote>> match_appearance(FrameSource& footage, const Scene& scene,
                                                                     Project& project, const MatchControl& control);

}  // namespace sigs
