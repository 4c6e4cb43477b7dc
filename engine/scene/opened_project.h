// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "base/result.h"
#include "project/project.h"
#include "scene/scene.h"
#include "scene/visibility.h"
#include "truth/annotation.h"
#include "video/frame_source.h"

namespace sigs {

// A project whose images can be made.
struct OpenedProject {
  FrameSource source;
  Scene scene;
  std::vector<Warning> warnings;  // of the footage, then of the rest
};

// Checks the project and opens all that it names. Errors name the project file and the field.
//   cancel  set: ends soon with the error interrupted; null or longer alive than what is opened
[[nodiscard]] Result<OpenedProject> open_project(const Project& project, const std::atomic<bool>* cancel);

// Error interrupted once cancel is set; null: never.
[[nodiscard]] Result<void> check_interrupt(const std::atomic<bool>* cancel);

// How many frames are sampled to find intruders that are never visible, where somebody is seen at once.
inline constexpr int kVisibilitySampleFrames = 20;

// All that is worth telling of a scene before its images are made: of the files that were read, what is hardly meant
// (scene/plausibility.h), and who is never visible. visibilities: of each intruder; empty: not looked at.
[[nodiscard]] std::vector<Warning> warnings_of(const Project& project, const Scene& scene,
                                               const std::vector<Visibility>& visibilities);

// Which frames are made; none asked for: the scene's own. Error usage: they do not lie in the scene's.
[[nodiscard]] Result<FrameRange> range_in(const Scene& scene, const std::optional<FrameRange>& asked_for);

// What labels of these frames say of the footage.
[[nodiscard]] FootageTruth footage_truth(const VideoInfo& footage, const FrameRange& range);

}  // namespace sigs
