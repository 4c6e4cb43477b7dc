// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ego_motion/ego_motion.h"
#include "scene/scene.h"
#include "world_lock/clip.h"

namespace sigs::bench {

inline constexpr double kDistances_m[] = {300, 1000, 10000};
// So far that a camera that travels has no parallax against it.
inline constexpr double kDistant_m[] = {1e6};

// What tells a project how the camera turns.
struct CameraKnowledge {
  std::string name;           // "constant attitude", "images", "images and gyroscope", "true attitude", "init"
  std::string track;          // camera.track.file; empty: none
  std::string attitude_file;  // camera.attitude_file; empty: none
  double readout_s = 0;
  int lost_frames = 0;  // that the estimation could not judge
  std::optional<GyroLink> gyro = {};
  std::filesystem::path project = {};  // instead of all these: a project file, of which the intruders are left out
  bool is_locked = true;               // false: of the project, camera.track is left out
};

// Constant attitude; estimated from the images; with the log's gyroscope; true: those that there are for the clip.
// Estimates are written into the folder. Stops the program where an estimation fails.
[[nodiscard]] std::vector<CameraKnowledge> knowledge_of(const Clip& clip, const std::filesystem::path& folder);

// The project that `sigs init` makes of the clip, without its camera.track and with it; `said` is its note of that. It
// is written into the folder. Stops the program where that fails.
struct InitKnowledge {
  std::vector<CameraKnowledge> cameras;
  std::string said;
};
[[nodiscard]] InitKnowledge init_knowledge_of(const Clip& clip, const std::filesystem::path& folder);

// An intruder that hovers where the camera saw a pixel.
struct Hovering {
  cv::Point2d pixel;
  double distance_m = 1000;
};

// The scene of a project with these intruders, which are seen at their pixels in `frame`. The camera does not travel,
// but where a project's log says so.
[[nodiscard]] Scene scene_with(const Clip& clip, const CameraKnowledge& camera, int frame,
                               const std::vector<Hovering>& intruders);

// Pixel of an intruder's reference point, as the truth has it; nothing where it has no image.
[[nodiscard]] std::optional<cv::Point2d> pixel_of(const Scene& scene, std::size_t intruder, int frame);

// Where intruders are put in a frame: up to `count` pixels within the far background whose neighbourhood has the most
// texture in its weaker direction, so that it can be followed both ways, 60 px or more apart. None where no
// neighbourhood has texture enough.
//   shift  of the far background since frame 0
[[nodiscard]] std::vector<cv::Point> places_in(const Clip& clip, int frame, int count, cv::Point shift = {});

}  // namespace sigs::bench
