// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "project/project.h"

namespace sigs {

// A mistake in a project, with the key of the field where it is.
struct Problem {
  std::string field;
  std::string what;
  ErrorKind kind = ErrorKind::bad_project;  // cannot_read: a file that it names does not exist
};

// Checks all that does not need the footage or the models: ranges, empty names, missing files, waypoints that are not
// finite, not in order of time or missing, labels, volumes and categories, and codec and container that do not go
// together. Empty: nothing is wrong.
[[nodiscard]] std::vector<Problem> validate(const Project& project);

// The problem as an error that names the project file too: {"projects/x.json: intruders[0].model.file", "no such file
// ..."}
[[nodiscard]] Error error_of(const Project& project, const Problem& problem);

}  // namespace sigs
