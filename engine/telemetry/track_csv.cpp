// SPDX-License-Identifier: MIT
#include "telemetry/track_csv.h"

namespace sigs {

bool is_track_csv(std::string_view) {
  return false;
}

Result<Track> read_track_csv(const std::filesystem::path& file, const ReadTrackOptions&) {
  return fail(file.string(), "is not read");
}

}  // namespace sigs
