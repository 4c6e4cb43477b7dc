// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "project/project.h"

namespace sigs {

// One of several names; get and set count them from 0.
struct Choice {
  std::vector<std::string_view> names;
  std::function<int()> get;
  std::function<void(int)> set;
};

// Where the value of a field lies. optional<...>: null in the file is allowed and means "none".
using FieldValue = std::variant<double*, int*, std::optional<double>*, std::optional<int>*, std::string*, glm::dvec3*,
                                std::vector<std::string>*, Choice>;

// One setting, described once for the file, --set, the inspector and docs/project-format.md.
struct Field {
  std::string key;  // "intruders[0].model.scale"
  FieldValue value;
  std::string_view unit;                                      // "" where it has none
  std::string_view help;                                      // one line
  double minimum = -std::numeric_limits<double>::infinity();  // of numbers, and of each part of a vector
  double maximum = std::numeric_limits<double>::infinity();
  bool is_path = false;
  bool required = false;  // may not be empty
};

// All fields of a project, with those of each intruder and waypoint that it has. The values point into the project,
// which must outlive the list and keep its intruders and waypoints where they are.
[[nodiscard]] std::vector<Field> fields_of(Project& project);

// Keys that hold the file's format and lists, and are no fields: "sigs", "intruders", "...waypoints".
inline constexpr int kProjectVersion = 1;

}  // namespace sigs
