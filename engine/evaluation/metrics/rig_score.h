// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evaluation/metrics/detection_score.h"
#include "evaluation/readers/rig_files.h"

namespace sigs {

// How well detectors of several cameras on one aircraft find its intruders together: docs/evaluation.md. A report
// counts where it matches the visible box by the rules of matches_of(). Times are the rig's. Durations are those of
// frames: each stands for the time from half-way to the frame before to half-way to the one after it, and what several
// cameras show at once counts once.

// A frame of a camera with a match.
struct RigDetection {
  std::size_t camera = 0;  // the first in the rig's order where frames of several have this very time
  double time_s = 0;
  double range_m = 0;        // from the aircraft's origin
  double bearing_rad = 0;    // in the aircraft's axes, to the right of the nose
  double elevation_rad = 0;  // above the plane of nose and wings
};

// Of one camera, or of all of them together.
struct RigShare {
  double seen_s = 0;      // some pixel of the intruder is visible
  double detected_s = 0;  // ... and a report matches it
  std::optional<double> first_seen_s;
  std::optional<RigDetection> first;

  [[nodiscard]] double share() const;  // detected_s / seen_s; NaN where it is never seen
};

struct RigHandoverScore {
  RigHandover truth;
  std::optional<RigDetection> last_before;  // by any camera, up to the time of the handover and that included
  std::optional<RigDetection> first_after;  // by any camera
  // Between these two, or from or to the end of what is seen where there is none: some camera shows the intruder, and
  // no report matches it.
  double loss_s = 0;
};

struct RigTargetScore {
  int target = 0;
  std::string name;
  RigShare any;
  std::vector<RigShare> cameras;  // in the rig's order
  std::vector<RigHandoverScore> handovers;
};

// One detector, or one for each camera, on one rig.
struct RigScore {
  std::string name;
  std::vector<RigTargetScore> targets;  // without distractors
  std::vector<int> false_alarm_boxes;   // of each camera
};

//   clips  truth and results of each camera, in the rig's order
[[nodiscard]] RigScore score_rig(const std::string& name, const RigClip& rig, const std::vector<DetectedClip>& clips,
                                 const DetectionPolicy& policy);

}  // namespace sigs
