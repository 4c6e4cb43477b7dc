// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "encounter/encounter_track.h"
#include "encounter/well_clear.h"

namespace sigs {

// Two flights over the time that they share: how near they came, when well clear was lost, and all quantities at given
// times. The flights are taken as they were flown: "lost" at a time depends on position and velocity at that time.

struct EncounterSettings {
  std::vector<WellClearVolume> volumes;  // as check_volume() accepts
  // For which a row is made; those outside of the time that both share have none. Any order.
  std::vector<double> row_times_s;
};

// A moment of the encounter. Distances are those flown, not predicted.
struct NearestMoment {
  double time_s = 0;
  double range_m = 0;  // slant
  double horizontal_m = 0;
  double vertical_m = 0;  // upwards, from the ownship to the intruder
};

// What an encounter is for one volume.
struct VolumeOutcome {
  WellClearVolume volume;
  // During which well clear is lost, by time; ends to 1e-6 s or better, where the flights end at the latest. Losses of
  // less than 1 ms may be left out, and a touch without duration is none.
  std::vector<TimeInterval> losses;
  // The greatest of loss_severity(), and when: 0 without losses. Found by 64 or more instants of each loss and refined
  // about the greatest.
  double worst_severity = 0;
  std::optional<double> worst_s = {};
  // Of the rows: how many are lost, and the first and last of them.
  int rows_lost = 0;
  std::optional<std::size_t> first_row_lost = {};
  std::optional<std::size_t> last_row_lost = {};
};

struct RowOfVolume {
  bool is_lost = false;
  double tau_mod_s = 0;  // for the volume's DMOD
  double severity = 0;
  std::optional<TimeInterval> predicted = {};  // predicted_loss(), in seconds from the row's time
};

// Everything at one time.
struct EncounterRow {
  double time_s = 0;
  AircraftState own;
  AircraftState intruder;
  RelativeQuantities quantities;
  std::vector<RowOfVolume> of_volumes;  // in the order of EncounterSummary::volumes
};

struct EncounterSummary {
  std::string own_name;
  std::string intruder_name;
  double first_s = 0;  // the time that both share
  double last_s = 0;   // at least first_s
  // Of several moments equally near the earliest.
  NearestMoment nearest;             // by slant range
  NearestMoment nearest_horizontal;  // its distances are the flown HMD and VMD
  std::vector<VolumeOutcome> volumes;
  VolumeOutcome nmac;                      // nmac_volume(), asked for or not
  std::vector<EncounterRow> rows;          // by rising time
  std::optional<std::size_t> nearest_row;  // of least horizontal distance
};

// Errors: bad_data where the flights share no time (they are named with theirs) or have a place that is not finite;
// those of check_volume().
[[nodiscard]] Result<EncounterSummary> encounter_of(const EncounterTrack& own, const EncounterTrack& intruder,
                                                    const EncounterSettings& settings);

// EncounterSummary::nearest and nearest_horizontal alone, in a small part of the time. Errors as above.
struct NearestMoments {
  NearestMoment slant;
  NearestMoment horizontal;
};
[[nodiscard]] Result<NearestMoments> nearest_moments(const EncounterTrack& own, const EncounterTrack& intruder);
[[nodiscard]] Result<NearestMoment> nearest_horizontal_moment(const EncounterTrack& own,
                                                              const EncounterTrack& intruder);

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
