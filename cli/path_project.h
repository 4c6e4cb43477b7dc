// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "base/result.h"
#include "geo/geo_path.h"
#include "geo/recorded_path.h"
#include "scene/geo_paths.h"

namespace sigs::cli {

// `sigs path` with projects: their paths out, recorded paths in.

// Whether a file is a project: JSON with the key "sigs". False for what cannot be read.
[[nodiscard]] bool is_project_file(const std::filesystem::path& file);

// The paths of a project's camera and intruders (scene/geo_paths.h). Its footage and log are opened. Warnings are
// printed. Error bad_project: the project has no place on the Earth.
[[nodiscard]] Result<std::vector<GeoPath>> paths_of_project(const std::filesystem::path& file);

struct IntoProject {
  std::filesystem::path project;  // is rewritten
  int intruder = 0;               // index; one more than there are: a copy of the last one is added
  TrafficSettings traffic;
};

// Writes a recorded path into a project as the waypoints of an intruder, and prints what was written.
[[nodiscard]] Result<void> write_into_project(const RecordedPath& path, const IntoProject& into);

}  // namespace sigs::cli
