// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "evaluation/metrics/detection_score.h"

namespace sigs {

// What a detector or tracker made of each encounter, frame by frame: the data that performance, sensor model and the
// check of it are made of. An encounter here is one intruder of one clip, as far as it is in view.

struct PerformancePolicy {
  DetectionPolicy matching;  // overlaps and score; its ranges and times are not used
  int declare_hits = 3;      // a track is declared where it has matched in so many ...
  int declare_window = 5;    // ... of the last so many frames, this one included
  double latency_s = 0;      // of the reporter: what it reports of a frame is known so much later
};

// Why an intruder that had been detected is not in a frame: the first of these that holds.
enum class DropOutCause {
  left_image,       // most of it lies outside the image
  clouds,           // they hide more than half of it
  hidden,           // by own body, occluder or other intruders: less than half can be seen
  score,            // a box on it has too low a score
  box,              // a box is there that overlaps too little
  crossed_horizon,  // it is on or below the horizon now and was above it
  small,            // its longer side is below 8 px
  low_contrast,     // RMS contrast below 0.1
  other
};
[[nodiscard]] const char* name_of(DropOutCause cause);
inline constexpr int kDropOutCauses = 9;

// A stretch of frames without a match between two with one, or up to where the intruder leaves for good.
struct DropOut {
  double length_s = 0;
  DropOutCause cause = DropOutCause::other;  // in its first frame
  bool is_last = false;                      // it lasts until the clip's end
};

// A frame in which some of the intruder is visible. Unknown numbers are NaN.
struct SeenFrame {
  int frame = 0;  // the footage's number
  double time_s = 0;
  double range_m = 0;
  bool is_detected = false;
  bool is_declared = false;  // a track was declared in this frame or before
  HorizonSide horizon = HorizonSide::unknown;
  double aspect_rad = std::numeric_limits<double>::quiet_NaN();
  double size_px = 0;
  double contrast = std::numeric_limits<double>::quiet_NaN();
  double visible_fraction = 0;
  std::optional<glm::dvec2> angle_error_rad = {};  // reported less true: to the right and up, in the camera's axes
  std::optional<double> range_error = {};          // (reported - true) / true
};

struct Declaration {
  double time_s = 0;   // of the clip, latency included
  double range_m = 0;  // at that time
  // Until the range is least, on straight flight from there on if the clip ends before; NaN: not known.
  double time_left_s = 0;
};

struct ObservedEncounter {
  std::string clip;
  int target = 0;
  std::string name;
  std::map<std::string, std::string> tags;  // of the dataset's video, and the intruder's kind
  std::vector<SeenFrame> frames;            // by time
  std::optional<double> latency_s = {};     // from the first frame in view to the first match
  std::optional<Declaration> declared = {};
  bool is_declared_at_once = false;  // with the first M frames in view: the clip's begin decided, not the range
  std::vector<DropOut> drop_outs;
  double closing_speed_mps = 0;  // how fast the range falls, mean over the frames before it is least; NaN: not known
};

// Tracks that are declared where there is no intruder.
struct FalseTracks {
  int clips = 0;
  double hours = 0;
  int declared = 0;  // tracks
  int boxes = 0;     // false alarms in single frames
};

struct Observations {
  std::string detector;
  std::vector<ObservedEncounter> encounters;
  FalseTracks all;    // of all footage
  FalseTracks empty;  // of clips in which no intruder is ever visible
  bool has_tracks = false;
  double rate_hz = 0;  // frames a second: the median of the clips
};

// A clip with what else is known of it.
struct PerformanceClip {
  DetectedClip detected;
  std::map<std::string, std::string> tags = {};
  std::map<int, std::string> kinds = {};  // by the intruder's id
  // The direction of a pixel in the camera's axes (X along the optical axis, Y right, Z down); empty: not known.
  std::function<std::optional<glm::dvec3>(double x_px, double y_px)> ray_of_pixel = {};
};

// Errors bad_data that name the clip: its truth has no ranges, no times or no identities.
[[nodiscard]] Result<Observations> observations_of(const std::string& detector,
                                                   const std::vector<PerformanceClip>& clips,
                                                   const PerformancePolicy& policy);

// To the right of the optical axis and above its horizontal plane, of a direction or place in the camera's axes.
[[nodiscard]] glm::dvec2 angles_of(const glm::dvec3& in_camera);

}  // namespace sigs
