// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <numbers>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "scene/scene.h"
#include "telemetry/track.h"
#include "video/frame_source.h"

namespace sigs::bench {

// What is known of a clip beforehand. Nothing here was chosen by any result.
struct ClipSource {
  std::string name;
  std::filesystem::path path;
  double focal_px = 0;  // pinhole, principal point in the middle; 0: by the guessed field of view
  double guessed_field_rad = std::numbers::pi / 3;  // across the image; see fit_guessed_lens()
  std::filesystem::path calibration = {};           // instead, where there is a file
  cv::Rect far_background = {};             // of a camera that travels: where intruders are put in frame 0; else empty
  cv::Size patch_px{40, 40};                // half the size of the background's patch that is followed around a point
  std::filesystem::path moving_boxes = {};  // CSV with one box per frame of what moves by itself; empty: none
  std::filesystem::path own_body = {};      // mask; empty: none
  std::filesystem::path attitude = {};      // the true one (camera.attitude_file); empty: not known
  bool finds_own_body = false;              // by detect_own_body()
  bool has_log = false;                     // telemetry within the video
};

// Whether its camera changes its place, so that near background moves by parallax.
[[nodiscard]] inline bool travels(const ClipSource& source) {
  return !source.far_background.empty();
}

// The clips of the folder SIGS_TEST_DATA that are there, then those of assets/footage.
[[nodiscard]] std::vector<ClipSource> clip_sources();

// A clip in memory.
struct Clip {
  ClipSource source;
  FootageShape shape;
  std::vector<cv::Mat> luma;     // CV_8UC1, of the footage's own size
  std::vector<cv::Rect> moving;  // one for each frame: moves by itself; empty: nothing
  cv::Mat own_body;              // CV_8UC1, above 127: own body; empty: none
  std::optional<Track> log;
  std::filesystem::path calibration;  // the file that the scene reads
  Camera camera;

  // CV_8UC1, 255 where a frame shows the world at rest.
  [[nodiscard]] cv::Mat world_mask(int frame) const;
  [[nodiscard]] int frame_count() const { return static_cast<int>(luma.size()); }
};

// Reads it, and writes the guessed calibration into the folder. Stops the program where that fails.
[[nodiscard]] Clip loaded(const ClipSource& source, const std::filesystem::path& folder);

// Where the lens is guessed and the clip's own turns show its focal length, that takes the guess's place. Returns what
// is known of the lens, for people.
[[nodiscard]] std::string fit_guessed_lens(Clip& clip, const std::filesystem::path& folder);

// Stops the program where it cannot be opened.
[[nodiscard]] FrameSource opened(const std::filesystem::path& path);

}  // namespace sigs::bench
