// SPDX-License-Identifier: MIT
#include <cmath>

#include "base/ensure.h"
#include "fuzz/fuzz_input.h"
#include "fuzz/track_promises.h"
#include "scene/scene_files.h"
#include "telemetry/log_formats.h"
#include "telemetry/track_csv.h"

namespace sigs::fuzz {

namespace {

void try_attitudes(const std::filesystem::path& path) {
  const Result<std::vector<AttitudeAtFrame>> attitudes = read_attitude_file(path);
  if (!attitudes) return check_message(attitudes.error());
  ENSURE(!attitudes->empty());
  for (std::size_t i = 0; i < attitudes->size(); ++i) {
    ENSURE(std::isfinite((*attitudes)[i].frame));
    ENSURE(i == 0 || (*attitudes)[i].frame > (*attitudes)[i - 1].frame);
  }
}

}  // namespace

void try_text_log(const FuzzInput& input) {
  try_attitudes(input.file("attitude.csv"));
  check_track_or_message(dji_subtitles_track(input.bytes, "log.srt"));
  const Result<Track> track = track_of_csv(input.bytes, "log.csv");
  check_track_or_message(track);
  if (track) check_track_or_message(track_of_csv(track_csv_text(*track), "again.csv"));
}

}  // namespace sigs::fuzz
