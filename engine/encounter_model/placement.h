// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.h"
#include "encounter_model/model_flight.h"

namespace sigs {

// Two drawn flights become an encounter: the intruder's is turned about the vertical and moved, so that it comes as
// close as is asked for at the time that is asked for.

// The closest approach, at the time of which all is meant.
struct ApproachRequest {
  double time_s = 0;  // of both tracks
  // Horizontal miss distance. Positive: on the ownship, looking in the direction that the intruder comes from, it
  // passes on the right; negative: on the left.
  double hmd_m = 0;
  double vmd_m = 0;  // vertical miss distance: the intruder's altitude less the ownship's
  // Direction that the intruder comes from, which is against the relative velocity, to the right of the ownship's
  // heading. 0: head-on, or the ownship overtakes it.
  double bearing_rad = 0;
};

// The intruder's track, turned and moved. At the time of the closest approach
// - the horizontal offset from the ownship is |hmd_m|, perpendicular to the horizontal relative velocity;
// - that is a local minimum of the horizontal range, and before and after it the range grows. Turning tracks may come
//   closer at a time that is not near;
// - its altitude is the ownship's plus vmd_m. The altitudes of its whole flight are raised by as much.
// An intruder slower than the ownship can come from a bearing in two ways; it flies the one of greater closing speed.
//   both tracks are of one frame, north east up, and begin at the same moment
// Errors bad_data, each of which names the quantity:
//   time      not within both tracks
//   bearing   the intruder is too slow to come from there: |sin(bearing)| times the ownship's speed is more than its
//   own,
//             or it would have to overtake. Also where the two would fly with equal velocities, or both hover: they
//             keep their distance and there is no closest approach (relative speed under 1e-6 m/s)
//   hmd       at that time the tracks turn so much that the range would be greatest there, not least
//   a number that is not finite
[[nodiscard]] Result<ModelFlight> placed_intruder(const ModelFlight& ownship, const ModelFlight& intruder,
                                                  const ApproachRequest& approach);

}  // namespace sigs
