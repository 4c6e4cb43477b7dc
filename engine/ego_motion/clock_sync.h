// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "ego_motion/ego_motion.h"
#include "ego_motion/settings.h"
#include "ego_motion/time_offset.h"
#include "telemetry/track.h"
#include "video/recording.h"

namespace sigs {

// How the clocks of two cameras on one aircraft belong together. Times are those of their footage: 0 is the
// presentation time of frame 0.

// Time of the first camera at an instant = offset_s + (1 + drift) * time of the second one.
struct ClockOffset {
  double offset_s = 0;
  double drift = 0;     // seconds a second; 0 where it is smaller than three times its standard deviation
  double sd_s = 0;      // standard deviation of the first camera's time at the second one's time middle_s
  double drift_sd = 0;  // infinite where nothing is known
  double middle_s = 0;  // of the part that both have seen, by the second camera's clock

  [[nodiscard]] double first_time_s(double second_s) const { return offset_s + (1 + drift) * second_s; }
};

// Turns from frame to frame about the camera's axes. Frames whose turn is not known and those that repeat the image
// before are left out; from a repeated one on, the turn counts from the image's first appearance.
[[nodiscard]] std::vector<SeenTurn> frame_turns(const EgoMotion& motion);

struct TurnSyncSettings {
  // Rotation from the axes of the second camera to those of the first, by how both are mounted. None: it is found.
  std::optional<glm::dquat> first_from_second = {};
  double max_offset_s = 3600;  // offsets beyond it are not looked at
};

struct TurnSync {
  ClockOffset clock;
  glm::dquat first_from_second{1, 0, 0, 0};  // as given, else as found
  double rotation_sd_rad = 0;  // of the worst axis, where it was found: large where the aircraft turned about one only
  double correlation = 0;      // of the angles that both have seen
  double overlap_s = 0;        // that both have seen
};

// The offset of the second camera's clock with which both have turned alike.
//   1. Rates in steps of 10 ms, or 15000 to a clip, are compared at all offsets. Without a known rotation their lengths
//      are, and for the best offsets the rotation is found by Wahba's problem (best_rotation()), then once more with
//      it. Which offset is the most significant counts, by the number of independent samples (Bartlett 1946), so that a
//      short overlap does not win by chance.
//   2. Angles, less their mean over two seconds, are fitted by offset, rotation and drift (Gauss and Newton; weights of
//      Geman and McClure); drift where both have seen a minute or more.
// Standard deviations are by the scatter among parts of half a second ("sandwich", White 1980), so that errors which
// are not independent from frame to frame count; at least what residuals that last make of the time if one
// in a second is independent, since attitudes of real footage have errors that follow the motion; and at least 0.3 ms.
// Turns are in order of time. A rolling shutter shifts what is found by what the middles of exposure are off the
// frames' times (EgoMotionSettings::readout_s).
// Errors (bad_data), without a place: fewer than 20 turns, no overlap; the cameras hardly turn, or not alike; several
// offsets fit as well; cancelled.
[[nodiscard]] Result<TurnSync> clock_by_turns(std::span<const SeenTurn> first, std::span<const SeenTurn> second,
                                              const TurnSyncSettings& settings = {}, const StepControl& control = {});

// The offset by the sound of both files, by the generalised cross correlation with phase transform (Knapp and Carter
// 1976) between 80 and 3500 Hz: parts of up to 20 s of the first one are looked for in all of the second one, and those
// that are found clearly have to agree. The deviation is that of the parts, and 10 ms by which cameras record image and
// sound apart.
// Errors (bad_data), without a place: shorter than a second, silent, no offset that stands out, parts that disagree.
[[nodiscard]] Result<ClockOffset> clock_by_sound(const Sound& first, const Sound& second, double max_offset_s = 3600,
                                                 const std::atomic<bool>* cancel = nullptr);

// The offset by the time codes of both frames 0, to 12 hours. Deviation: one frame of each, evenly distributed; where
// one of the codes counts 29.97 or 59.94 frames without dropping numbers and the other is of another kind, what the
// hours of the day add besides. Clocks that were never set alike show no deviation of their own.
[[nodiscard]] ClockOffset clock_by_time_codes(const TimeCode& first, const TimeCode& second);

// What offsets can be found by, the most exact first.
enum class ClockSource { turns, sound, log, time_code, creation_time };

// "turns", "sound", "log", "time code", "creation time".
[[nodiscard]] const char* name_of(ClockSource source);

// What is known of a camera.
struct CameraRecording {
  std::filesystem::path video;
  const EgoMotion* motion = nullptr;  // null: not estimated
  const Track* log = nullptr;         // null: none
};

struct ClockFinding {
  ClockSource source = ClockSource::turns;
  std::optional<ClockOffset> clock;  // none: `text` says why
  std::string text;                  // one line: what it rests on
  std::optional<TurnSync> turns;     // of source turns, where it was found
};

// What each source shows of the second camera's clock, in the order of ClockSource.
//   sources  those to look at; empty: all
// Errors: interrupted. What cannot be read is said in the finding.
[[nodiscard]] Result<std::vector<ClockFinding>> found_clocks(const CameraRecording& first,
                                                             const CameraRecording& second,
                                                             std::span<const ClockSource> sources = {},
                                                             const TurnSyncSettings& settings = {},
                                                             const StepControl& control = {});

// The finding with the least deviation, whose place in the list it is. None: nothing was found.
[[nodiscard]] std::optional<std::size_t> best_of(std::span<const ClockFinding> findings);

}  // namespace sigs
