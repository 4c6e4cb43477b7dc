// SPDX-License-Identifier: MIT
// The published pairs and the figures that programs of others give for them.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "encounter/daa_file.h"
#include "encounter/encounter.h"
#include "encounter/well_clear.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

EncounterSummary pair(const std::string& name, double zthr_ft = 450) {
  const Result<EncounterFile> file = read_encounter_file((real_data() / "encounters/pairs" / name).string());
  REQUIRE_MESSAGE(file, file.error().text());
  REQUIRE(file->tracks.size() == 2);
  CHECK(file->warnings.empty());
  EncounterSettings settings{.volumes = {{"en route", 4000 * kFoot_m, 4000 * kFoot_m, 35, zthr_ft * kFoot_m, 0}}};
  for (const TrackSample& sample : file->tracks[0].samples) settings.row_times_s.push_back(sample.time_s);
  Result<EncounterSummary> summary = encounter_of(track_of(file->tracks[0]), track_of(file->tracks[1]), settings);
  REQUIRE_MESSAGE(summary, summary.error().text());
  return *summary;
}

std::string printed(double number, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, number);
  return text;
}

std::string feet(double metres, int decimals) {
  return printed(metres / kFoot_m, decimals);
}

// Rows lost: "67..108 (42)".
std::string rows_of(const VolumeOutcome& outcome) {
  if (outcome.rows_lost == 0) return "none";
  return std::to_string(*outcome.first_row_lost) + ".." + std::to_string(*outcome.last_row_lost) + " (" +
         std::to_string(outcome.rows_lost) + ")";
}

double horizontal_m(const EncounterSummary& summary, std::size_t row) {
  return summary.rows.at(row).quantities.horizontal_range_m;
}

}  // namespace

TEST_CASE("converging.csv: rows lost, the first of them and the least distance are the known ones") {
  if (!has_real_data()) return;
  const EncounterSummary high = pair("converging.csv", 700);
  CHECK(rows_of(high.volumes[0]) == "67..108 (42)");
  CHECK(feet(horizontal_m(high, *high.volumes[0].first_row_lost), 2) == "21532.20");
  CHECK(feet(horizontal_m(high, *high.nearest_row), 4) == "1767.9088");
  CHECK(*high.nearest_row == 103);
  CHECK(rows_of(pair("converging.csv", 450).volumes[0]) == "none");
}

TEST_CASE("headon.csv: likewise, with a descent through the ownship's height") {
  if (!has_real_data()) return;
  const EncounterSummary high = pair("headon.csv", 700);
  CHECK(rows_of(high.volumes[0]) == "65..103 (39)");
  CHECK(feet(horizontal_m(high, *high.volumes[0].first_row_lost), 2) == "29615.87");
  CHECK(feet(horizontal_m(high, *high.nearest_row), 1) == "2500.0");
  CHECK(*high.nearest_row == 100);
  CHECK(rows_of(pair("headon.csv", 450).volumes[0]) == "65..98 (34)");
}

TEST_CASE("sampled pairs: the least horizontal distance, the vertical one there, and when, are the known ones") {
  if (!has_real_data()) return;
  struct Known {
    const char* name;
    const char* horizontal_ft;
    const char* vertical_ft;
    const char* time_s;
  };
  for (const Known& known : {Known{"uncor_pair_1.txt", "149.8270", "211.148", "150.0"},
                             Known{"uncor_pair_2.txt", "139.2434", "663.708", "150.0"},
                             Known{"uncor_pair_3.txt", "1483.2110", "716.912", "149.9"}}) {
    CAPTURE(known.name);
    const EncounterSummary summary = pair(known.name);
    const EncounterRow& row = summary.rows[*summary.nearest_row];
    CHECK(feet(row.quantities.horizontal_range_m, 4) == known.horizontal_ft);
    CHECK(feet(std::abs(row.quantities.vertical_m), 3) == known.vertical_ft);
    CHECK(printed(row.time_s, 1) == known.time_s);
    // Between the samples it is nearer still, but not by more than is flown in half an interval.
    CHECK(summary.nearest_horizontal.horizontal_m <= row.quantities.horizontal_range_m);
    CHECK(std::abs(summary.nearest_horizontal.time_s - row.time_s) < 0.1);
  }
}

TEST_CASE("intervals lie between the samples at which the rows change") {
  if (!has_real_data()) return;
  for (const char* name : {"converging.csv", "headon.csv"}) {
    const EncounterSummary summary = pair(name, 700);
    REQUIRE(summary.volumes[0].losses.size() == 1);
    const TimeInterval loss = summary.volumes[0].losses[0];
    const double first_s = summary.rows[*summary.volumes[0].first_row_lost].time_s;
    const double last_s = summary.rows[*summary.volumes[0].last_row_lost].time_s;
    CHECK(loss.begin_s <= first_s);
    CHECK(loss.begin_s > first_s - 1);
    CHECK(loss.end_s >= last_s);
    CHECK(loss.end_s < last_s + 1);
    // Both fly straight: the entry was predictable at the start.
    const std::optional<TimeInterval> predicted = summary.rows[0].of_volumes[0].predicted;
    REQUIRE(predicted);
    CHECK(predicted->begin_s == doctest::Approx(loss.begin_s).epsilon(1e-9));
    CHECK(predicted->end_s == doctest::Approx(loss.end_s).epsilon(1e-9));
  }
}
