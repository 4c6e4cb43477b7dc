// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "ego_motion/ego_motion.h"
#include "first_project/first_project.h"
#include "telemetry/track.h"
#include "video/frame_source.h"

namespace sigs {

// The horizontal or, of a portrait image, vertical field of view that is taken where nothing is known, degrees: between
// those of phones and drones (65 to 75) and the linear modes of action cameras (70 to 90).
inline constexpr double kGuessedFov_deg = 70;

// From this field of view on a lens is taken for a fisheye with equal angles a pixel; no pinhole camera is so wide.
inline constexpr double kFisheyeFov_deg = 120;

// The lens of a first project.
struct FirstCamera {
  Camera camera;                 // of the footage's size
  std::string calibration_text;  // of the file to be written; empty: the user's file is used
  FirstProjectNote note;         // field footage.calibration
  bool is_default = false;       // of kGuessedFov_deg, since nothing tells it
};

// The camera of the user's calibration file, else of the stated field of view, else of what the file says, else of
// kGuessedFov_deg. Pixels that are not square are respected.
//   logged  what the footage's file or its log says; may be nothing
// Errors: those of read_calibration(); usage for a field of view out of range.
[[nodiscard]] Result<FirstCamera> first_camera(const FirstProjectOptions& options, const VideoInfo& video,
                                               const std::optional<LoggedLens>& logged);

// The camera of kGuessedFov_deg with the focal length that the turns of the images show instead.
[[nodiscard]] Result<FirstCamera> camera_by_turns(const VideoInfo& video, const FocalScale& seen);

}  // namespace sigs
