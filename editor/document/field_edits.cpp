// SPDX-License-Identifier: MIT
#include "editor/document/field_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <type_traits>

#include "base/text.h"

namespace sigs::editor {

namespace {

// Beside a number. Frames are named by the label.
std::string unit_text(std::string_view unit) {
  if (unit.empty() || unit == "frame") return "";
  return unit == "deg" ? "°" : std::string(" ").append(unit);
}

std::string word_for_none(std::string_view key) {
  if (key.starts_with("geo.") || key == "camera.readout_s" || key == "camera.exposure_s") return "from the log";
  if (key.starts_with("light.sun.")) return "by time and place";
  if (key == "appearance.codec.quantiser") return "the stream's";
  if (key == "appearance.haze.visibility_m") return "clear air";
  if (key == "footage.cloud_distance_m") return "hide nothing";
  return key.starts_with("camera.attitude_deg.") ? "not set" : "none";
}

struct Words {
  const Field& field;

  std::string operator()(double value) const { return number_text(value, field.unit); }
  std::string operator()(int value) const { return number_text(value, field.unit); }
  template <class Number>
  std::string operator()(const std::optional<Number>& value) const {
    return value ? (*this)(*value) : word_for_none(field.key);
  }
  std::string operator()(const std::string& value) const { return value.empty() ? "none" : value; }
  std::string operator()(const glm::dvec3& v) const {
    return fmt::format("{}, {}, {}", number_text(v.x), number_text(v.y), number_text(v.z, field.unit));
  }
  std::string operator()(const std::vector<std::string>& values) const {
    return values.empty() ? "none" : listed(values);
  }
  std::string operator()(ChosenName value) const {
    const auto* const choice = std::get_if<Choice>(&field.value);
    const auto index = static_cast<std::size_t>(value.index);
    return choice != nullptr && index < choice->names.size() ? with_spaces(choice->names[index]) : "";
  }
};

// Of a limit: short even where it is only there to keep numbers finite.
std::string limit_text(double limit) {
  if (std::abs(limit) < 1e6) return number_text(limit);
  char text[64];
  std::snprintf(text, sizeof text, "%g", limit);
  return text;
}

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
  template <class Text>
  bool operator()(Text* place, const Text& value) const {
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
  const auto found = std::ranges::find(fields, key, &Field::key);
  return found == fields.end() ? nullptr : &*found;
}

std::unique_ptr<Project> without_waypoints(const Project& project) {
  auto copy = std::make_unique<Project>(project);
  for (IntruderSettings& intruder : copy->intruders) intruder.trajectory.waypoints.clear();
  return copy;
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

std::string with_spaces(std::string_view name) {
  std::string text(name);
  std::ranges::replace(text, '_', ' ');
  return text;
}

bool matches(const Field& field, std::string_view words) {
  const std::string where = lower_case(fmt::format("{} {} {}", field.key, label_of(field.key), field.help));
  const std::string wanted = lower_case(words);
  for (std::size_t begin = 0; begin < wanted.size();) {
    const std::size_t end = std::min(wanted.find(' ', begin), wanted.size());
    if (where.find(wanted.substr(begin, end - begin)) == std::string::npos) return false;
    begin = end + 1;
  }
  return true;
}

std::string range_text(const Field& field) {
  const bool low = std::isfinite(field.minimum);
  const bool high = std::isfinite(field.maximum);
  if (low && high)
    return fmt::format("{} to {}{}", limit_text(field.minimum), limit_text(field.maximum), unit_text(field.unit));
  if (low) return fmt::format("at least {}{}", limit_text(field.minimum), unit_text(field.unit));
  return high ? fmt::format("at most {}{}", limit_text(field.maximum), unit_text(field.unit)) : "";
}

std::string word_for_zero(std::string_view key) {
  constexpr std::array<std::string_view, 4> kAsTheClipAsks{"own_body.paper.canny_low", "own_body.paper.canny_high",
                                                           "own_body.paper.dilation_px", "own_body.paper.closing_px"};
  if (std::ranges::find(kAsTheClipAsks, key) != kAsTheClipAsks.end()) return "auto";
  return key == "own_body.settled_percent" ? "never" : "";
}

std::string value_text(const Field& field, const PlainValue& value) {
  if (value == PlainValue(0.0) || value == PlainValue(0))
    if (const std::string word = word_for_zero(field.key); !word.empty()) return word;
  return std::visit(Words{field}, value);
}

std::string advice(const Problem& problem, const Field* field) {
  if (field == nullptr) return "";
  if (field->is_path && std::get<std::string*>(field->value)->empty())
    return "Choose the file, or drop it onto the window.";
  if (field->is_path && problem.kind == ErrorKind::cannot_read)
    return field->required ? "Choose where the file lies." : "Choose where the file lies, or leave the field empty.";
  if (field->is_path) return "Choose another file.";
  return "";
}

std::string number_format(double value, std::string_view unit) {
  const double magnitude = std::abs(value);
  const int before_point = magnitude >= 1 ? static_cast<int>(std::floor(std::log10(magnitude))) + 1 : 1;
  const int digits = std::clamp(before_point + 2, 6, 15);
  const std::string beside = unit == "%" ? " %%" : unit_text(unit);
  return fmt::format("%.{}g{}", digits, beside);
}

std::string number_text(double value, std::string_view unit) {
  char text[64];
  const std::string format = number_format(value, "");
  std::snprintf(text, sizeof text, format.c_str(), value + 0.0);  // no minus before a zero
  return text + unit_text(unit);
}

std::vector<std::string> extensions_for(std::string_view key) {
  if (key.ends_with(".video")) return {".mp4", ".mov", ".mkv", ".avi", ".webm", ".m4v", ".mts", ".png"};
  if (key.ends_with(".calibration")) return {".xml", ".yml", ".yaml", ".json"};
  if (key.ends_with("mask")) return {".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff"};
  if (key.ends_with(".attitude_file")) return {".csv"};
  if (key.ends_with(".track.file"))
    return {".csv", ".srt", ".ulg", ".bin", ".mp4", ".mov", ".ts", ".klv", ".txt", ".log"};
  if (key.ends_with(".model.file")) return {".obj"};
  return {};
}

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

bool is_finite(const PlainValue& value) {
  if (const auto* const number = std::get_if<double>(&value)) return std::isfinite(*number);
  if (const auto* const number = std::get_if<std::optional<double>>(&value)) return std::isfinite(number->value_or(0));
  const auto* const vector = std::get_if<glm::dvec3>(&value);
  return vector == nullptr || is_finite(*vector);
}

bool put_value(const Field& field, const PlainValue& value) {
  return std::visit(Put{field}, field.value, value);
}

bool put_value(Project& project, std::string_view key, const PlainValue& value) {
  const auto put_there = [&](const std::vector<Field>& fields) {
    const Field* field = find_in(fields, key);
    return field != nullptr && put_value(*field, value);
  };
  if (key.find(".waypoints[") != std::string_view::npos) return put_there(fields_of(project));
  std::vector<ModelSettings> before;
  for (const IntruderSettings& intruder : project.intruders) before.push_back(intruder.model);
  const bool put = with_waypoints_aside(project, put_there);
  for (std::size_t i = 0; i < before.size(); ++i) keep_axes_apart(project.intruders[i].model, before[i]);
  return put;
}

FieldSheet::FieldSheet(const Project& project)
    : project_(without_waypoints(project)),
      defaults_(std::make_unique<Project>(default_project_like(*project_))),
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
