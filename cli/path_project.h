// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "base/result.h"
#include "geo/geo_path.h"
#include "geo/recorded_path.h"
#include "project/project.h"
#include "scene/geo_paths.h"

namespace sigs::cli {

// `sigs path` with projects: their paths out, recorded paths in.

// The project in a file; none where the file is no project: not JSON that has a member of projects or begins as one, or
// not readable. Warnings are printed. Errors are those of read_project(): a project, but a broken one.
[[nodiscard]] Result<std::optional<Project>> project_in(const std::filesystem::path& file);

// The paths of a project's camera and intruders (scene/geo_paths.h). Its footage and log are opened. Warnings are
// printed. Error bad_project: the project has no place on the Earth.
[[nodiscard]] Result<std::vector<GeoPath>> paths_of_project(const Project& project);

struct IntoProject {
  std::filesystem::path project;  // is rewritten
  int intruder = 0;               // index; one more than there are: a copy of the last one is added
  TrafficSettings traffic;
};

// Writes a recorded path into a project as the waypoints of an intruder, and prints what was written.
[[nodiscard]] Result<void> write_into_project(const RecordedPath& path, const IntoProject& into);

}  // namespace sigs::cli
