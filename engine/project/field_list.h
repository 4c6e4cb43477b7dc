// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "project/fields.h"

namespace sigs {

// How fields.cpp and its parts collect the fields of a project.

inline constexpr double kFarthest_m = 1e8;  // farther than any aircraft; beyond it even double metres lose millimetres

template <class Enum>
Choice choice_of(Enum& value, std::vector<std::string_view> names) {
  return {.names = std::move(names),
          .get = [&value] { return static_cast<int>(value); },
          .set = [&value](int index) { value = static_cast<Enum>(index); }};
}

// Collects fields under a common beginning of their keys.
class FieldList {
 public:
  FieldList(std::vector<Field>& fields, std::string prefix) : fields_(fields), prefix_(std::move(prefix)) {}

  Field& add(std::string_view key, FieldValue value, std::string_view unit, std::string_view help) {
    return fields_.emplace_back(
        Field{.key = prefix_ + std::string(key), .value = std::move(value), .unit = unit, .help = help});
  }

  void number(std::string_view key, FieldValue value, std::string_view unit, double minimum, double maximum,
              std::string_view help) {
    Field& field = add(key, std::move(value), unit, help);
    field.minimum = minimum;
    field.maximum = maximum;
  }

  void path(std::string_view key, std::string& value, bool required, std::string_view help) {
    Field& field = add(key, &value, "", help);
    field.is_path = true;
    field.required = required;
  }

 private:
  std::vector<Field>& fields_;
  std::string prefix_;
};

// Those below light.
void add_light(FieldList list, LightSettings& light);
// Those below compositing.
void add_compositing(FieldList list, CompositingSettings& compositing);
// Those below appearance.
void add_appearance(FieldList list, AppearanceSettings& appearance);
// Those of an intruder, by the beginning of its keys, "intruders[0].".
void add_intruder(std::vector<Field>& fields, const std::string& prefix, IntruderSettings& intruder);

}  // namespace sigs
