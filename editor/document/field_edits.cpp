// SPDX-License-Identifier: MIT
#include "editor/document/field_edits.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace sigs::editor {

namespace {

bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

double in_range(const Field& field, double number) {
  return std::clamp(number, field.minimum, field.maximum);
}

int in_range(const Field& field, int number) {
  return static_cast<int>(in_range(field, static_cast<double>(number)));
}

// One way of putting for each kind of place; what does not fit falls through to the last.
struct Put {
  const Field& field;

  bool operator()(double* place, double value) const {
    if (!std::isfinite(value)) return false;
    *place = in_range(field, value);
    return true;
  }
  bool operator()(int* place, int value) const {
    *place = in_range(field, value);
    return true;
  }
  template <class Number>
  bool operator()(std::optional<Number>* place, const std::optional<Number>& value) const {
    if (value && !std::isfinite(static_cast<double>(*value))) return false;
    *place = value ? std::optional<Number>(in_range(field, *value)) : std::nullopt;
    return true;
  }
  bool operator()(glm::dvec3* place, const glm::dvec3& value) const {
    if (!is_finite(value)) return false;
    *place = glm::clamp(value, field.minimum, field.maximum);
    return true;
  }
  bool operator()(std::string* place, const std::string& value) const {
    *place = value;
    return true;
  }
  bool operator()(std::vector<std::string>* place, const std::vector<std::string>& value) const {
    *place = value;
    return true;
  }
  bool operator()(const Choice& choice, ChosenName value) const {
    if (value.index < 0 || static_cast<std::size_t>(value.index) >= choice.names.size()) return false;
    choice.set(value.index);
    return true;
  }
  template <class Place, class Value>
  bool operator()(const Place&, const Value&) const {
    return false;
  }
};

const Field* find_in(const std::vector<Field>& fields, std::string_view key) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& field) { return field.key == key; });
  return found == fields.end() ? nullptr : &*found;
}

std::unique_ptr<Project> without_waypoints(const Project& project) {
  auto copy = std::make_unique<Project>(project);
  for (IntruderSettings& intruder : copy->intruders) intruder.trajectory.waypoints.clear();
  return copy;
}

std::unique_ptr<Project> default_project(std::size_t intruders) {
  auto project = std::make_unique<Project>();
  project->intruders.resize(intruders);
  return project;
}

bool lie_along_each_other(const ModelSettings& model) {
  return model.forward.size() == 2 && model.up.size() == 2 && model.forward[1] == model.up[1];
}

void keep_axes_apart(ModelSettings& model, const ModelSettings& before) {
  if (!lie_along_each_other(model) || lie_along_each_other(before)) return;
  if (model.forward != before.forward)
    model.up = before.forward;
  else
    model.forward = before.up;
}

}  // namespace

PlainValue value_of(const Field& field) {
  return std::visit(
      [](const auto& place) -> PlainValue {
        if constexpr (std::is_same_v<std::decay_t<decltype(place)>, Choice>)
          return ChosenName{place.get()};
        else
          return *place;
      },
      field.value);
}

bool put_value(const Field& field, const PlainValue& value) {
  return std::visit(Put{field}, field.value, value);
}

bool put_value(Project& project, std::string_view key, const PlainValue& value) {
  if (key.find(".waypoints[") != std::string_view::npos) {
    const std::vector<Field> fields = fields_of(project);
    const Field* field = find_in(fields, key);
    return field != nullptr && put_value(*field, value);
  }
  std::vector<ModelSettings> before;
  for (const IntruderSettings& intruder : project.intruders) before.push_back(intruder.model);
  std::vector<std::vector<WaypointSettings>> aside;
  for (IntruderSettings& intruder : project.intruders)
    aside.push_back(std::exchange(intruder.trajectory.waypoints, {}));
  const std::vector<Field> fields = fields_of(project);
  const Field* field = find_in(fields, key);
  const bool put = field != nullptr && put_value(*field, value);
  for (std::size_t i = 0; i < aside.size(); ++i) {
    project.intruders[i].trajectory.waypoints = std::move(aside[i]);
    keep_axes_apart(project.intruders[i].model, before[i]);
  }
  return put;
}

FieldSheet::FieldSheet(const Project& project)
    : project_(without_waypoints(project)),
      defaults_(default_project(project.intruders.size())),
      fields_(fields_of(*project_)),
      default_fields_(fields_of(*defaults_)) {}

const Field* FieldSheet::find(std::string_view key) const {
  return find_in(fields_, key);
}

PlainValue FieldSheet::default_of(const Field& field) const {
  const Field* twin = find_in(default_fields_, field.key);
  return twin == nullptr ? value_of(field) : value_of(*twin);
}

bool FieldSheet::can_be_reset(const Field& field) const {
  const PlainValue usual = default_of(field);
  const auto* const text = std::get_if<std::string>(&usual);
  if (field.required && text != nullptr && text->empty()) return false;
  return value_of(field) != usual;
}

}  // namespace sigs::editor
