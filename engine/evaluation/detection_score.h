// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evaluation/results.h"
#include "evaluation/truth.h"

namespace sigs {

// The airborne metrics, as published with the Airborne Object Tracking challenge; docs/evaluation.md defines each.
struct DetectionPolicy {
  double least_area_px2 = 100;   // smaller boxes of the truth are grown to it, about their middle (extended overlap)
  double match_overlap = 0.2;    // extended overlap of a match
  double false_overlap = 0.02;   // less with every truth: a false alarm; between the two: neither
  double least_score = 0;        // reports below it are left out
  double longest_range_m = 700;  // an encounter is within it
  int least_encounter_frames = 30;
  int longest_gap_frames = 3;
  double detect_range_m = 300;  // an encounter counts as detected where it is before it comes nearer than this
  double window_s = 3;          // ... in at least half the frames of a window of this length
  double least_window_share = 0.5;
};

// One film and what a detector says of it.
struct DetectedFilm {
  std::string name;
  FilmTruth truth;
  Results results;
};

struct EncounterScore {
  std::string film;
  int target = 0;
  int first_frame = 0;
  int last_frame = 0;
  HorizonSide horizon = HorizonSide::on;  // of most of its frames
  bool is_detected = false;               // in time
  std::optional<double> first_detection_range_m;
  std::optional<double> first_detection_time_s;  // from the encounter's first frame
  int frames_matched = 0;
};

struct DetectionRate {
  int encounters = 0;
  int detected = 0;
  [[nodiscard]] double rate() const { return encounters > 0 ? double(detected) / encounters : 0; }
};

struct DetectionScore {
  std::string name;
  std::vector<EncounterScore> encounters;
  DetectionRate all;
  DetectionRate above_horizon;
  DetectionRate on_horizon;
  DetectionRate below_horizon;
  int frames = 0;
  double hours = 0;
  int false_alarm_tracks = 0;        // tracks of the reporter with at least one false alarm
  double false_alarms_per_hour = 0;  // false_alarm_tracks / hours
  int false_alarm_boxes = 0;
  double false_boxes_per_frame = 0;  // FPPI
  double frame_detection_rate = 0;   // AFDR: matched (frame, target) pairs of all within longest_range_m
  double mean_first_range_m = 0;     // over encounters with any detection; NaN where there is none
};

[[nodiscard]] double extended_overlap(const Box& truth, const Box& reported, double least_area_px2);

[[nodiscard]] DetectionScore score_detections(const std::string& name, const std::vector<DetectedFilm>& films,
                                              const DetectionPolicy& policy);

}  // namespace sigs
