// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "project/fields.h"
#include "project/validate.h"

namespace sigs::editor {

// What a field holds, by itself; of a Choice the number of the name.
struct ChosenName {
  int index = 0;
  [[nodiscard]] bool operator==(const ChosenName&) const = default;
};
using PlainValue = std::variant<double, int, std::optional<double>, std::optional<int>, std::string, glm::dvec3,
                                std::vector<std::string>, ChosenName>;

[[nodiscard]] PlainValue value_of(const Field& field);
// False for numbers and vectors with a part that is not finite.
[[nodiscard]] bool is_finite(const PlainValue& value);

// Numbers are brought into the field's range. A value of another type, one that is not finite and a name that a choice
// does not have leave the field alone; false then.
bool put_value(const Field& field, const PlainValue& value);

// By the field's key. A model's forward that is put along its up (or the other way round) takes the other's place,
// which gets the old one: on the way from one pair of axes to another no step is invalid. False too where the project
// has no such field. Quick however many waypoints there are, unless the key is a waypoint's.
bool put_value(Project& project, std::string_view key, const PlainValue& value);

// What `call` returns for the fields of a project but its waypoints', which are put aside meanwhile: quick however many
// there are.
template <class Call>
auto with_waypoints_aside(Project& project, const Call& call) {
  std::vector<std::vector<WaypointSettings>> aside;
  for (IntruderSettings& intruder : project.intruders)
    aside.push_back(std::exchange(intruder.trajectory.waypoints, {}));
  const auto result = call(fields_of(project));
  for (std::size_t i = 0; i < aside.size(); ++i) project.intruders[i].trajectory.waypoints = std::move(aside[i]);
  return result;
}

// The fields of one state of a project, to be looked at for as long as that state lasts. Without the waypoints', of
// which there can be ten thousand.
class FieldSheet {
 public:
  explicit FieldSheet(const Project& project);

  [[nodiscard]] const std::vector<Field>& fields() const { return fields_; }
  [[nodiscard]] const Field* find(std::string_view key) const;  // null: there is none

  // What a new project would have there.
  [[nodiscard]] PlainValue default_of(const Field& field) const;
  // Differs from the default, and the default is a value to go back to: a path that may not be empty has none.
  [[nodiscard]] bool can_be_reset(const Field& field) const;

 private:
  std::unique_ptr<Project> project_;  // the fields point into them
  std::unique_ptr<Project> defaults_;
  std::vector<Field> fields_;
  std::vector<Field> default_fields_;  // in the same order
};

// A name of the project file as words: "constant_speed" is "constant speed".
[[nodiscard]] std::string with_spaces(std::string_view name);

// How a key is called on the screen: "camera.speed_mps" is "Speed".
[[nodiscard]] std::string label_of(std::string_view key);

// "video codec" finds "export.video.codec": every word is in the key, the label or the help, in any case of letters.
[[nodiscard]] bool matches(const Field& field, std::string_view words);

// "-1000 to 1000 m/s", "at least 0 m"; "" where every number is good.
[[nodiscard]] std::string range_text(const Field& field);
// What a 0 of this field means, where it is no number: "auto", "never"; "": it is one.
[[nodiscard]] std::string word_for_zero(std::string_view key);
// "22 m/s", "none", "0, 0, -150 m", "constant speed", "auto".
[[nodiscard]] std::string value_text(const Field& field, const PlainValue& value);

// What the person can do about a problem; "" where the problem itself says so. field: null where the key has none.
[[nodiscard]] std::string advice(const Problem& problem, const Field* field);

// Where in the window a setting that was guessed is found out or chosen: "Horizon... sets it."; "": at its row.
[[nodiscard]] std::string advice_on_guess(std::string_view key);

// Whether a setting is among those that most projects need. The inspector shows the others on demand, and where they
// are wrong or guessed.
[[nodiscard]] bool is_common(std::string_view key);

// A printf format for a number: hundredths, more of small numbers, no zeros at the end; with the unit where it is
// shown beside numbers (frames are not).
[[nodiscard]] std::string number_format(double value, std::string_view unit);
[[nodiscard]] std::string number_text(double value, std::string_view unit = "");

// What the files of a path field are usually called: {".obj"}; empty: no telling.
[[nodiscard]] std::vector<std::string> extensions_for(std::string_view key);

}  // namespace sigs::editor
