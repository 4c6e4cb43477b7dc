// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/json.h"
#include "base/result.h"
#include "project/project.h"

namespace sigs {

// A setting whose value is one of several names. get and set use the name's index, counted from 0.
struct Choice {
  std::vector<std::string_view> names;  // as the file has them
  std::function<int()> get;
  std::function<void(int)> set;
};

// Points to the value of a field. optional<...>: the file may say null, which means "none".
using FieldValue = std::variant<double*, int*, std::optional<double>*, std::optional<int>*, std::string*, glm::dvec3*,
                                std::vector<std::string>*, Choice>;

// One setting. This description serves the project file, --set, the editor's inspector and docs/project-format.md.
struct Field {
  std::string key;  // "intruders[0].model.scale"
  FieldValue value;
  std::string_view unit;                                      // "" where it has none
  std::string_view help;                                      // one line
  double minimum = -std::numeric_limits<double>::infinity();  // of numbers, and of each component of a vector
  double maximum = std::numeric_limits<double>::infinity();
  bool is_path = false;
  bool required = false;  // may not be empty
};

// All fields of a project, including those of each intruder and waypoint that it has. They point into the project,
// which must outlive the list and must not move its intruders and waypoints meanwhile. The keys of the format ("sigs")
// and of lists ("intruders", "...waypoints") are not fields.
[[nodiscard]] std::vector<Field> fields_of(Project& project);

// A project of defaults with the same fields: as many cameras, intruders, waypoints and rotors.
[[nodiscard]] Project default_project_like(const Project& project);

// The version of the project file's format, the value of its key "sigs".
inline constexpr int kProjectVersion = 1;

// Sets one field from a text "key=value": "camera.speed_mps=30", "light.position_m=[0,0,-500]",
// "export.video.codec=h264". The value is JSON; what is not JSON is taken as a string. Paths are relative to the
// project file, like those in it. Does not check ranges; validate() does. Errors of the kind usage, which name the
// assignment: no "=", no such key (a similar one is suggested), a value of the wrong type.
[[nodiscard]] Result<void> set_field(Project& project, const std::string& assignment);

// The end of a message about an unknown key, "; did you mean seed?": the key with the smallest edit distance
// (Levenshtein), which must be at most half of the longer one's length. Empty: no key is similar.
[[nodiscard]] std::string suggestion(std::span<const std::string> keys, const std::string& key);

// Where a key stands in a project file: "intruders[0].model.scale" -> /intruders/0/model/scale.
[[nodiscard]] Json::json_pointer pointer_of(std::string_view key);

// Sets a field to a JSON value. Returns what is wrong ("expected a number, found \"fast\""); empty where nothing is.
// Does not check ranges; validate() does.
[[nodiscard]] std::string put_json(const Json& json, const Field& field);

// The field's value as JSON.
[[nodiscard]] Json json_of(const Field& field);

}  // namespace sigs
