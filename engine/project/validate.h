// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "project/project.h"

namespace sigs {

// Something wrong with a project, by the key of the field that it is in.
struct Problem {
  std::string field;
  std::string what;
  ErrorKind kind = ErrorKind::bad_project;  // cannot_read: a file that it names is not there
};

// All that can be seen without opening footage or models: ranges, empty names, missing files, waypoints that are not
// finite, without order in time or none at all, codec and container that do not go together. Empty: nothing is wrong.
[[nodiscard]] std::vector<Problem> validate(const Project& project);

// {"projects/x.json: intruders[0].model.file", "no such file ..."}
[[nodiscard]] Error error_of(const Project& project, const Problem& problem);

}  // namespace sigs
