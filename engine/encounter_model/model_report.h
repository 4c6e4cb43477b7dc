// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "encounter_model/model_flight.h"

namespace sigs {

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

}  // namespace sigs
