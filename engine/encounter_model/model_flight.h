// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "base/random.h"
#include "base/result.h"
#include "encounter_model/encounter_model.h"

namespace sigs {

// Where an aircraft is and what it does from this second on.
struct SampledPoint {
  double time_s = 0;                   // from the flight's begin
  glm::dvec3 position_neu_m{0, 0, 0};  // north, east, up; up is the model's altitude
  double heading_rad = 0;              // of the motion over the ground, from north to the east; not wrapped
  double speed_mps = 0;                // horizontal; never negative
  double vertical_speed_mps = 0;       // up; this and the two below hold until the next point
  double acceleration_mps2 = 0;        // of the horizontal speed
  double turn_rate_radps = 0;          // to the right
};

// The state `after_s` >= 0 seconds after a point, in closed form: vertical speed, acceleration and turn rate are
// constant, so heading and speed are linear in time and the path over the ground is the integral of
// (speed + acceleration t) (cos, sin)(heading + turn_rate t). An aircraft whose speed has fallen to 0 stays where it
// is, turning and climbing, while its acceleration is negative. Exact to rounding for all turn rates, the smallest too.
[[nodiscard]] SampledPoint moved_on(const SampledPoint& point, double after_s);

// A drawn flight: a point for each second. Position, heading and speed are continuous; vertical speed is not.
struct ModelFlight {
  std::vector<SampledPoint> points;    // at 0 s, 1 s, ...; at least one
  std::vector<double> initial_values;  // of all variables, in the file's units, the altitude rounded as below
  // Never below altitude 0, and always faster than the lowest and slower than the highest limit of the speed's bins. A
  // model's walk knows no limits; the published program discards flights that leave these.
  bool is_within_limits = true;
  int redraws = 0;  // flights that were discarded before this one

  [[nodiscard]] double duration_s() const { return points.back().time_s; }
};

struct ModelFlightSettings {
  int duration_s = 60;  // 1 or more
  // The altitude of a flight that begins level (vertical rate exactly 0) is rounded to a multiple of this, halves
  // downward; not where that would be the ground, altitude 0. 0: never rounded.
  double level_step_ft = 500;
  int max_redraws = 0;  // how often a flight that leaves the limits may be drawn anew; the last one stays as it is
};

// The place on the flight at a time within it, by moved_on() from the point before.
[[nodiscard]] SampledPoint at_time(const ModelFlight& flight, double time_s);

// Which variables fly the aircraft: "L" altitude in ft, "v" speed in kt, "\dot v" acceleration in kt/s, "\dot h"
// vertical rate in ft/min, "\dot \psi" turn rate in deg/s. All but the altitude may be missing and are 0 then: balloons
// have no speed of their own. v is taken as speed over the ground, without wind, whatever the vertical rate. Error
// bad_data: there is no L, or one of them is a category.
[[nodiscard]] Result<void> check_can_fly(const EncounterModel& model);

// A flight that begins at north 0, east 0, heading north. Altitude and speed are the model's at the first second, and
// from then on the integrals of its rates; their bins stay the same and go on steering the rates. Needs a model that
// can fly. Bins and values of all seconds are the same bits on every machine; positions also depend on the C library's
// sine and cosine.
[[nodiscard]] ModelFlight drawn_flight(const EncounterModel& model, const ModelFlightSettings& settings,
                                       Random& random);

// Drawing from a model. All of it is sums and products of numbers of the file and of Random, so that a seed gives
// the same bits on every machine.

// The state of an aircraft at a second, by variable.
struct ModelState {
  std::vector<int> bins;       // from 0
  std::vector<double> values;  // in the file's units; of a category the number of its bin, from 1

  [[nodiscard]] bool operator==(const ModelState&) const = default;
};

// The bins at the first second: each variable in the network's order, given the bins of its parents, with the counts as
// probabilities. A configuration of the parents that was never counted gives all bins of the variable with equal
// probability. One random number for each variable.
[[nodiscard]] std::vector<int> initial_bins(const EncounterModel& model, Random& random);

// The bins a second later. Variables without a successor (\dot v has one, L and v have none in the published models)
// keep theirs. In a configuration of the parents that was never counted a variable keeps its bin too, as in the prior
// of the published program that lets nothing change.
[[nodiscard]] std::vector<int> next_bins(const EncounterModel& model, const std::vector<int>& bins, Random& random);

// A value of a bin: uniform within it; exactly 0 in the zero bin, of a category the bin's number from 1. No random
// number is taken for these two.
[[nodiscard]] double value_in_bin(const ModelVariable& variable, int bin, Random& random);

// The state at the first second: initial_bins(), then a value of each in the order of the variables.
[[nodiscard]] ModelState initial_state(const EncounterModel& model, Random& random);

// The state a second later: next_bins(), then for each variable in order: another value where its bin has changed;
// where it has not, another value of the same bin with the probability resample_rate, else the same value. A random
// number decides that for each unchanged variable whose rate is above 0.
[[nodiscard]] ModelState next_state(const EncounterModel& model, const ModelState& state, Random& random);

// A model and its flights as text and as a drawing.

// A table of the variables: what each is and its unit as far as the label is known, the number of bins, their limits,
// the zero bin, seconds between other values within a bin, parents at the first second and a second later. Below it the
// counts, free parameters, and configurations of parents without a count, of both networks. Ends with a line feed.
[[nodiscard]] std::string model_report_text(const EncounterModel& model);

// The first line of a table of flights, with its line feed: track, time_s, north_m, east_m, up_m, heading_deg (0..360,
// from north to the east), speed_mps, vertical_speed_mps, acceleration_mps2, turn_rate_degps (to the right), and the
// labels of the model's categories.
[[nodiscard]] std::string track_csv_header(const EncounterModel& model);

// A line for each second of the flight. Metres with 4 decimals, all else with 6.
[[nodiscard]] std::string track_csv_rows(const ModelFlight& track, int number, const EncounterModel& model);

// Flights drawn one below the other: from above in metres (north up, both axes to the same scale), and altitude in m,
// speed in m/s and vertical speed in m/s over time in s. BGR, 8 bits. Needs at least one flight.
[[nodiscard]] cv::Mat flights_plot(const std::vector<ModelFlight>& tracks);

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
