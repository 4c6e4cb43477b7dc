// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "performance/confidence.h"
#include "performance/observations.h"

namespace sigs {

// The performance of a sensor by range: how likely it detects, where it declares, what that leaves in time, how often
// it cries wolf, and under which conditions it is worse. docs/performance.md defines each figure.

// A range and how sure it is. 0: the probability is reached nowhere. Infinite: it is reached at the farthest frame
// seen.
struct RangeAt {
  double probability = 0.5;
  double range_m = 0;
  Interval interval;
};
inline constexpr std::array kProbabilities{0.5, 0.9, 0.95};

// Frames between two ranges.
struct RangeBin {
  double low_m = 0;
  double high_m = 0;  // infinite: the last
  double mean_m = 0;  // of its frames
  int encounters = 0;
  int frames = 0;
  int detected = 0;
  Interval interval;  // of detected / frames, clustered_interval()
};

// P(success | range) over some frames.
struct RangeCurve {
  int encounters = 0;
  int frames = 0;
  int successes = 0;
  Interval interval;  // of successes / frames
  double farthest_m = 0;
  std::vector<RangeBin> bins;  // those with frames
  FallingCurve fit;
  std::vector<RangeAt> ranges;    // of kProbabilities
  std::vector<double> band_at_m;  // places of the band
  std::vector<Interval> band;     // of the fit, at these
};

// The part of all encounters' frames that has something in common.
struct Condition {
  std::string by;    // "horizon", "aspect", "size", "contrast", "kind", "tag sky", ...
  std::string name;  // "below"
  RangeCurve detected;
  bool is_too_few = false;  // fewer encounters than PerformancePolicy asks: figures are there, but say little
};

// Of numbers such as ranges of declaration: empty means none.
struct Spread {
  int count = 0;
  double least = 0, p05 = 0, median = 0, p95 = 0, greatest = 0;
};
[[nodiscard]] Spread spread_of(std::vector<double> values);

// Errors of angles or ranges.
struct ErrorSpread {
  int count = 0;
  double bias = 0;
  double standard_deviation = 0;
  double p95 = 0;  // of the size
};

struct DropOutCount {
  DropOutCause cause = DropOutCause::other;
  int count = 0;
  double seconds = 0;
};

struct Performance {
  std::string detector;
  PerformancePolicy policy;
  int min_encounters = 10;
  bool has_tracks = false;
  double rate_hz = 0;
  RangeCurve detected;  // by frame
  RangeCurve declared;  // by declared track
  std::vector<Condition> conditions;
  int encounters_declared = 0;
  int declared_at_once = 0;    // of these, with the first frames in view
  Spread declaration_range_m;  // of those declared
  Spread time_left_s;          // of those with a known time
  Spread latency_s;            // from the first frame in view to the first match
  ErrorSpread bearing_rad;
  ErrorSpread elevation_rad;
  ErrorSpread range;  // relative
  Spread drop_out_s;  // without those that last until the end
  std::vector<DropOutCount> drop_outs;
  FalseTracks false_all;
  FalseTracks false_empty;
  Interval false_per_hour_all;
  Interval false_per_hour_empty;
  std::vector<ObservedEncounter> encounters;
};

// All figures. Conditions with fewer encounters than min_encounters are marked.
[[nodiscard]] Performance performance_of(Observations observations, const PerformancePolicy& policy,
                                         int min_encounters = 10);

// A curve over frames of encounters that are chosen; draws of encounters for its intervals.
//   success  of a frame
//   chosen   whether a frame counts
[[nodiscard]] RangeCurve range_curve(const std::vector<ObservedEncounter>& encounters,
                                     const std::function<bool(const SeenFrame&)>& success,
                                     const std::function<bool(const ObservedEncounter&, const SeenFrame&)>& chosen,
                                     int draws = 1000);

// --- The range that is needed.

// What lies between a detection and safety. R = protect + closing speed (latency + decide + manoeuvre).
struct NeededTimes {
  double latency_s = 0;    // of the sensor and what follows it, beyond what the declaration ranges hold already
  double decide_s = 2;     // assumed where not stated
  double manoeuvre_s = 8;  // assumed where not stated: until the manoeuvre has moved the aircraft out of the way
};
struct AirSpeeds {
  double own_mps = 25;
  double intruder_mps = 45;  // 70 m/s head-on
};

enum class Geometry { head_on, crossing, overtaking };
[[nodiscard]] const char* name_of(Geometry geometry);

struct NeededRange {
  Geometry geometry = Geometry::head_on;
  std::string volume;  // "well clear", "NMAC"
  double closing_speed_mps = 0;
  double needed_m = 0;  // 0: it does not close
  int encounters = 0;   // that were declared or not, of this geometry
  RangeAt reached;      // by declared tracks at P = 0.95, of frames of this aspect
  bool is_too_few = false;
  // No: it does not suffice; none: not known, since nothing was seen of this geometry or not far enough.
  std::optional<bool> suffices;
};

// Head-on: the speeds add up; crossing: they are perpendicular; overtaking: the own aircraft is behind the intruder.
// Frames count where their aspect is within 30 degrees of that of such a collision course: 0, atan(own / intruder), pi.
[[nodiscard]] std::vector<NeededRange> needed_ranges(const Performance& performance, const AirSpeeds& speeds,
                                                     const NeededTimes& times);

}  // namespace sigs
