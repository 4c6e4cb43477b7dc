// SPDX-License-Identifier: MIT
#include <cmath>

#include "base/ensure.h"
#include "encounter/daa_file.h"
#include "encounter/encounter.h"
#include "fuzz/fuzz_input.h"

namespace sigs::fuzz {

namespace {

void check_file(const Result<EncounterFile>& file) {
  if (!file) return check_message(file.error());
  check_messages(file->warnings);
  ENSURE(file->tracks.size() >= 2);
  for (const SampledTrack& track : file->tracks) ENSURE(check_track(track).has_value());
  const Result<EncounterFile> again = parse_daa(daa_text(file->tracks), "again.daa");
  if (!again) check_message(again.error());
  const Result<NearestMoment> nearest = nearest_horizontal_moment(track_of(file->tracks[0]), track_of(file->tracks[1]));
  if (!nearest) return check_message(nearest.error());
  ENSURE(nearest->range_m >= 0 && nearest->horizontal_m >= 0);
}

}  // namespace

void try_encounter(const FuzzInput& input) {
  check_file(parse_daa(input.bytes, "pair.daa"));
  check_file(parse_pair_csv(input.bytes, "pair.csv"));
  check_file(read_encounter_file(input.file("pair")));
}

}  // namespace sigs::fuzz
