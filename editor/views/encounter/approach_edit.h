// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "editor/views/context.h"
#include "encounter/encounter.h"
#include "encounter/planned_approach.h"

namespace sigs::editor {

// The closest approach of an intruder as it is edited: what it is, and the waypoints that make it another one. The same
// for the form in the inspector and for the handle in the world view.

// The closest approach (least horizontal distance) of the flight that is there, within the project's frames.
struct PresentApproach {
  PlannedApproach approach;
  AircraftState own;  // at that time
  AircraftState intruder;
  double frame = 0;       // fractional
  bool is_within = true;  // false: the least distance is at an end of the clip, where it still falls or has only risen
  bool is_straight = true;        // the intruder flies straight at constant velocity, to 1 mm
  NearestMoment nearest_3d = {};  // of least slant range, which is another moment where one climbs
};

// Of an intruder of the project, by the scene that is open, which may be of an older revision than the document. None
// where there is no scene, or the intruder is not in it.
[[nodiscard]] std::optional<PresentApproach> present_approach(const ViewContext& context, int intruder);

// The same, found once for each scene that is opened.
class PresentApproachMemory {
 public:
  // Null as above; valid until the next call.
  [[nodiscard]] const PresentApproach* of(const ViewContext& context, int intruder);

 private:
  std::shared_ptr<const OpenedScene> scene_;
  int intruder_ = -1;
  std::optional<PresentApproach> found_;
};

// What an edit of the approach starts from: kept for as long as a gesture lasts, so that all its steps are measured
// from one state.
struct ApproachStart {
  int intruder = 0;  // of the project
  PresentApproach present;
  EncounterTrack own;
  EncounterTrack flight;
  TrajectoryPlan plan;
  double first_frame = 0;  // where the waypoints of a straight flight stand; last_frame > first_frame
  double last_frame = 1;
  double first_s = 0;  // their times
  double last_s = 1;
  std::optional<LocalFrame> earth = {};  // for waypoints that are places on the Earth
  FootageShape footage;                  // times of frames
};
// None as of present_approach(), and while the open scene is not the document's present state.
[[nodiscard]] std::optional<ApproachStart> approach_start(const ViewContext& context, int intruder);

// The approach whose misses are those of the start, both in the same proportion larger or smaller, so that the least
// slant range becomes distance_m >= 0; equal misses of 0 become horizontal. Where no proportion does: the reason.
[[nodiscard]] tl::expected<PlannedApproach, std::string> approach_at_distance(const ApproachStart& start,
                                                                              double distance_m);

// Queues the edit as part of a gesture; "": done, else the reason why not, and nothing changes.
[[nodiscard]] std::string change_approach(const ViewContext& context, const ApproachStart& start,
                                          const PlannedApproach& wanted, const std::string& gesture);

// Queues that the flight becomes straight with the closest approach that it has; "" or the reason why not, as above.
[[nodiscard]] std::string make_straight(const ViewContext& context, const ApproachStart& start);

// "62.1 m to the right, 14.0 m above"
[[nodiscard]] std::string misses_text(const PlannedApproach& approach);

}  // namespace sigs::editor
