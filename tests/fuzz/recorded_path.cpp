// SPDX-License-Identifier: MIT
#include "geo/recorded_path.h"

#include <cmath>

#include "base/ensure.h"
#include "fuzz/fuzz_input.h"

namespace sigs::fuzz {

void try_recorded_path(const FuzzInput& input) {
  const Result<std::vector<RecordedPath>> paths = recorded_paths_of(input.bytes, "path.gpx");
  if (!paths) return check_message(paths.error());
  ENSURE(!paths->empty());
  for (const RecordedPath& path : *paths) {
    check_messages(path.warnings);
    ENSURE(!path.points.empty());
    for (std::size_t i = 0; i < path.points.size(); ++i) {
      ENSURE(check_place(path.points[i].place).has_value());
      ENSURE(std::isfinite(path.points[i].time_s));
      ENSURE(i == 0 || path.points[i].time_s > path.points[i - 1].time_s);
    }
    const PathExtent extent = extent_of(path.points);
    ENSURE(extent.south_deg <= extent.north_deg && extent.low_m <= extent.high_m);
  }
}

}  // namespace sigs::fuzz
