// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "evaluation/readers/aot_files.h"

namespace sigs {

// Scores as the program published with the Airborne Object Tracking challenge computes them, its peculiarities
// included, so that figures can be held against published ones. docs/evaluation.md names where these rules differ from
// our own (detection_score.h).

struct AotPolicy {
  double min_score = 0;      // reports with a lower score are ignored
  int min_track_length = 0;  // frames, gaps included, since its track's first report; earlier ones do not count
  std::optional<double> target_fppi;  // at most one of the two: min_score is raised until the rate, rounded to 5
  std::optional<double>
      target_hfar;  // decimals, is met, by halving the interval from the lowest score to 1 down to 1e-5
};

// A true object beside a report of the same image; no report: the image has none.
struct AotPair {
  int object = 0;               // index of AotTruth::objects
  int report = -1;              // index of the reports; -1: none
  double object_area_px2 = 0;   // grown to 100 px^2 about its middle; 0: an image without object
  double report_area_px2 = 0;   // grown likewise where the object was; 0: no report
  double overlap = 0;           // intersection over union of the boxes as they are
  double extended_overlap = 0;  // of the grown ones
  bool is_match = false;
  bool is_no_match = false;  // far from this object: of a false alarm all pairs are
};

// Consecutive rows of one object within 700 m, of at least 30 rows, that come within 330 m.
struct AotEncounter {
  int number = 0;  // among those of all lengths and ranges, by flight and object
  int flight = 0;
  std::vector<int> objects;  // indices of AotTruth::objects, by frame
  double above_horizon = 0;  // mean
};

// Whether and where an encounter is detected.
struct AotEncounterScore {
  int matched_rows = 0;
  double largest_share = 0;  // of matched rows in a window of 30
  std::optional<double> range_m;
  std::optional<int> latency_frames;
  bool is_detected = false;  // at 300 m or more, or in less than 30 frames
};

struct AotScore {
  AotPolicy policy;
  double working_score = 0;    // the lowest score that counted
  double fppi = 0;             // false detections / images
  double hfar = 0;             // tracks with a false detection / hours, each flight of which is two minutes
  int planned_rows = 0;        // objects of known range
  int unplanned_rows = 0;      // all others, images without object included
  int unplanned_aircraft = 0;  // airplanes and helicopters of these
  double largest_range_m = 0;  // of those within 700 m
  int rows_in_range = 0, matched_in_range = 0;
  int large_rows = 0, matched_large = 0;  // aircraft above 200 px^2, grown
  int small_rows = 0, matched_small = 0;
  std::vector<AotEncounter> encounters;
  std::vector<AotEncounterScore> by_detection;  // of each encounter
  std::vector<AotEncounterScore> by_track;
  int unknown_images = 0;  // reports of images that the truth does not have: ignored
};

// All objects of each image with all its reports, in order of objects, then of reports.
[[nodiscard]] std::vector<AotPair> aot_pairs(const AotTruth& truth, const std::vector<AotReport>& reports);

// Errors, without a place: a target that cannot be met by any score; no images.
[[nodiscard]] Result<AotScore> aot_score(const AotTruth& truth, const std::vector<AotReport>& reports,
                                         const AotPolicy& policy);

}  // namespace sigs
