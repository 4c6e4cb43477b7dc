// SPDX-License-Identifier: MIT
#include "telemetry/read_track.h"

#include "base/input_file.h"

namespace sigs {

Result<Track> read_track(const std::filesystem::path& file, const ReadTrackOptions&) {
  if (const Result<void> there = check_input_file(file, "flight log"); !there) return fail(there.error());
  return fail(file.string(), "is no flight log that SIGS reads");
}

}  // namespace sigs
