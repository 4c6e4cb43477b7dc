// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <vector>

#include "base/result.h"
#include "ego_motion/project_motion.h"
#include "first_project/first_project.h"
#include "scene/scene.h"
#include "telemetry/track.h"
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

// The camera's turns as the images show them (ego_motion).
struct FirstMotion {
  std::optional<FocalScale> focal;  // the lens is another one: of its focal length; the track is by that
  std::optional<Track> track;       // attitudes on the footage's time axis; none: the camera's attitude stays as it is
  FoundAttitudes attitudes;         // of the track, for follow_attitudes(), without the file's name
  FirstProjectNote note;            // what was found, or why there is none
};

struct FirstMotionOptions {
  bool horizon_is_seen = true;   // false: an edge that may look like one does not count
  bool lens_is_guessed = false;  // the focal length may be that which the turns show
  const Track* log = nullptr;    // of the flight, with angular rates or none; its positions become the track's
};

// Finds them where they help. None where the camera stands still (no more than half a pixel; three where there are cuts
// or jerks between), where more than a twentieth of the frames used are lost, where nothing tells the turn of a frame
// within a pixel, and for footage longer than 90 s. Error: interrupted.
[[nodiscard]] Result<FirstMotion> first_motion(FrameSource& footage, const Scene& scene,
                                               const FirstMotionOptions& options, const MatchControl& control);

}  // namespace sigs
