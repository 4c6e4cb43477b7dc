// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "camera/camera.h"
#include "ego_motion/settings.h"
#include "telemetry/track.h"
#include "video/frame_source.h"

namespace sigs {

struct EgoMotionControl {
  // Called on the calling thread. The whole work, counted in frames: the last fifth of them stands for what follows
  // when all frames are decoded, the comparison with the log and the adjustment.
  std::function<void(int done, int total)> progress;
  // Set to true: ends within a fraction of a second, in any step, with the error `interrupted`.
  const std::atomic<bool>* cancel = nullptr;
};

// The standard deviation, rad, of a rotation of which nothing is known.
inline constexpr double kUnknownRotation_rad = 3.14159265358979;

// The camera's attitude in one frame.
struct EgoFrame {
  double time_s = 0;                         // of the footage
  glm::dquat world_from_camera{1, 0, 0, 0};  // yaw 0 is the heading at frame 0; roll and pitch: EgoMotion::level_sd_rad
  glm::dvec3 sd_rad{0};  // standard deviation of the rotation since frame 0: small turns about the camera's X, Y, Z
  glm::dvec3 step_sd_rad{0};  // the part of it that is independent from frame to frame
  int features = 0;           // that agree with the rotation
  bool is_lost = false;      // the turn since the frame before is not known: attitude held, sd_rad kUnknownRotation_rad
  bool is_cut = false;       // lost although both frames have enough features: another scene, or a jump
  bool is_repeated = false;  // the image of the frame before again
};

// How log and footage belong together, where a gyroscope was compared with the images.
struct GyroLink {
  double offset_s = 0;  // time of the log less that of the footage, at the footage's middle
  double offset_sd_s = 0;
  double drift = 0;  // change of the offset, seconds a second; 0 where it is not significant
  double drift_sd = 0;
  double correlation = 0;  // of rates seen and recorded
  double slope = 0;        // rates seen over rates recorded: 1 where calibration and log agree
  bool is_fused = false;   // false: they do not belong together, and the images alone are used
};

// The focal length that the image's own turns show, over that of the calibration. When a camera turns, what is at the
// image's border moves otherwise than what is in its middle, by the square of the tangent of its angle from the axis.
struct FocalScale {
  double value = 1;    // as good as any other; 1: the calibration
  double least = 0;    // smaller ones do not fit
  double largest = 0;  // larger ones do not fit; 0: any larger one fits, as where the camera turns little
};

struct EgoMotion {
  std::vector<EgoFrame> frames;        // one for each frame of the footage
  std::optional<double> level_sd_rad;  // standard deviation of the world's level, common to all frames: a horizon was
                                       // seen. Not given: roll and pitch are against frame 0, which counts as level
  std::optional<GyroLink> gyro;
  std::optional<FocalScale> focal_scale;  // what the turns show of it; nothing is corrected by it, but where asked for
  // The focal length with which all is computed, over the calibration's (EgoMotionSettings::fits_focal_length).
  double focal_factor = 1;
  bool is_stabilized = false;     // the log states that the camera turned the image (Track::camera_from_image)
  std::vector<Warning> warnings;  // with ranges of frames; first what puts the whole in doubt: many frames of
                                  // which nothing is known, a lens unlike its calibration
};

// The camera's rotation frame by frame, in one pass over the footage: README.md. The time of a frame is that of its
// middle row (EgoMotionSettings::readout_s).
//   own_body   CV_8UC1 of the footage's size, above 127 where the own body hides the world; empty: nowhere
//   telemetry  log of the same flight, with rates about the camera's axes or none; null: none. Its times are compared
//   with
//              the footage's, an offset of up to 1 s (on_footage_time) or 10 s is found
// A frame whose motion cannot be known says so in its flags and standard deviation and in a warning; that is no error.
// Errors: bad_data (fewer than 2 frames; calibration or mask of another size; a frame of another size, settings out of
// range), cannot_read, interrupted.
[[nodiscard]] Result<EgoMotion> estimate_ego_motion(FrameSource& footage, const Camera& camera, const cv::Mat& own_body,
                                                    const Track* telemetry, const EgoMotionSettings& settings,
                                                    const EgoMotionControl& control);

// The number of frames whose rotation since frame 0 is not known: its standard deviation is above 90 degrees.
[[nodiscard]] int unknown_frames(const EgoMotion& motion);

// The share of such frames above which a motion is of no use: a camera that follows it hardly moves.
inline constexpr double kMaxUnknownShare = 0.5;

// Error bad_data with the two numbers where their share is above that.
//   where  what the error names: the footage
[[nodiscard]] Result<void> check_known(const EgoMotion& motion, const std::string& where,
                                       double max_unknown_share = kMaxUnknownShare);

// The same as a track, to be written or used as any other: ned_from_camera with camera_attitude_sd_rad, in which the
// level's uncertainty is included; heading_is_north is false, on_footage_time true. Lost frames are left out.
// level_is_known says whether roll and pitch are absolute; attitude_is_whole is true.
[[nodiscard]] Track track_of(const EgoMotion& motion, const std::filesystem::path& footage);

// Adds to the attitudes what the log of the same flight knows besides: position, velocity, exposure, UTC, on the
// footage's time axis, and the readout. Positions are left out where the log's place on that axis is not known: it has
// another axis, and no gyroscope that was compared with the images.
void add_log(Track& attitudes, const Track& log, const EgoMotion& motion);

// Looks for runs of repeated frames too long for a doubled one, of which nothing can be known; marks them lost and all
// that follows unknown; then adds the warnings that name frames: lost, cut, repeated, no horizon.
void add_low_confidence_frames(EgoMotion& motion, const std::string& where);

// "3-7, 12 and 20 more": rising numbers as ranges, the first ten of them.
[[nodiscard]] std::string ranges_text(std::span<const int> numbers);

}  // namespace sigs
