// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <string_view>

#include "base/result.h"
#include "encounter/encounter.h"

namespace sigs {

// An encounter as a table for people, with a line feed at its end: nearest moments, the nearest of the rows, and for
// each volume its limits and the losses. Lengths in metres and feet.
[[nodiscard]] std::string encounter_report_text(const EncounterSummary& summary);

// Encounters as JSON, for programs: one object for each, in it one for each row ("steps"). Names end in the unit;
// angles are in degrees, to the right and upwards. null stands for what does not come: an infinite time, no loss.
// docs/encounters.md lists the members.
//   source  the file that the flights come from
[[nodiscard]] std::string encounter_json_text(std::span<const EncounterSummary> encounters, const std::string& source);

// The same text piece by piece, so that memory does not grow with the number of rows. Ends with the first error of
// `put`.
[[nodiscard]] Result<void> put_encounter_json(std::span<const EncounterSummary> encounters, const std::string& source,
                                              const std::function<Result<void>(std::string_view)>& put);

// Encounters over time: when well clear is lost, a lane for each volume; range; times (modified tau, closest approach);
// vertical offset with the volumes' limits, one below the other, for each encounter. BGR. Empty where no encounter has
// a row.
[[nodiscard]] cv::Mat encounter_plot(std::span<const EncounterSummary> encounters);

}  // namespace sigs
