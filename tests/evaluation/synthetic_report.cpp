// SPDX-License-Identifier: MIT
#include "evaluation/synthetic_report.h"

#include <limits>

#include "evaluation/clips.h"
#include "evaluation/metrics/track_score.h"

namespace sigs::test {

namespace {

constexpr Box kAtStart{100.5, 200.5, 40, 20};

Box truth_in(int frame) {
  return moved(kAtStart, 2.0 * frame, 0.5 * frame);
}

}  // namespace

TrackReport synthetic_track_report() {
  const ClipTruth clip = clip_of(30, 25, [](int frame) {
    TargetFrame target = visible_at(truth_in(frame));
    target.distance_m = 800 - 10 * frame;
    if (frame >= 20 && frame < 25) target.visible.reset();
    return target;
  });
  Results off{.name = "off", .frames_per_s = 12.5};
  for (int frame = 0; frame < 30; ++frame) report(off, frame, moved(truth_in(frame), 3, 4));
  Results odd{.name = kSpecialName};
  for (int frame = 0; frame < 10; ++frame) report(odd, frame, truth_in(frame));
  report(odd, 15, truth_in(15));
  TrackReport made{.clip = "clip <1>", .footage = clip.footage, .target = "intruder 0 (glider)"};
  for (const Results& results : {off, odd, Results{.name = "silent"}})
    made.scores.push_back(score_track(clip, clip.targets.front(), results, made.policy));
  made.remarks = {"kcf: frame 3: OpenCV cannot follow in it: (a < b) & c"};
  return made;
}

DetectionReport synthetic_detection_report() {
  EncounterScore seen{.clip = "one, \"1\"",
                      .last_frame = 99,
                      .horizon = HorizonSide::above,
                      .min_range_m = 120.5,
                      .is_detected = true,
                      .first_detection_range_m = 512.25,
                      .first_detection_time_s = 0.5,
                      .frames_visible = 100,
                      .frames_matched = 90};
  EncounterScore unseen = seen;
  unseen.is_detected = false;
  unseen.first_detection_range_m.reset();
  unseen.first_detection_time_s.reset();
  unseen.frames_matched = 0;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const DetectionScore good{.name = kSpecialName,
                            .encounters = {seen},
                            .all = {1, 1},
                            .above_horizon = {1, 1},
                            .frames = 100,
                            .hours = 4.0 / 3600,
                            .false_alarm_tracks = 2,
                            .false_alarms_per_hour = 1800,
                            .false_alarm_boxes = 3,
                            .false_boxes_per_frame = 0.03,
                            .frame_detection_rate = 0.9,
                            .mean_first_range_m = 512.25};
  const DetectionScore blind{.name = "blind",
                             .encounters = {unseen},
                             .all = {1, 0},
                             .above_horizon = {1, 0},
                             .frames = 100,
                             .hours = 4.0 / 3600,
                             .mean_first_range_m = nan};
  return {.clips = {"one, \"1\""}, .scores = {good, blind}};
}

}  // namespace sigs::test
